// A work group for each tile: the layers that are blocked at some pixel, and those that are not at some.
layout(local_size_x = 8, local_size_y = 8) in;
const ivec2 kPixels = ivec2(2);  // of a thread: tiles are those of render/tile_lights.glsl

uniform usampler2D shadowMask;
uniform sampler2D depth;  // reversed

layout(std430) writeonly buffer TileBitBlock { uvec2 tileBits[]; };

shared uint blocked, lit;

void main() {
  if (gl_LocalInvocationIndex == 0u) blocked = lit = 0u;
  barrier();
  ivec2 first = ivec2(gl_GlobalInvocationID.xy) * kPixels, size = textureSize(depth, 0);
  uint ownBlocked = 0u, ownLit = 0u;
  for (int i = 0; i < kPixels.x * kPixels.y; ++i) {
    ivec2 pixel = first + ivec2(i % kPixels.x, i / kPixels.x);
    bool drawn = all(lessThan(pixel, size)) && texelFetch(depth, min(pixel, size - 1), 0).r > 0.0;
    uint bits = texelFetch(shadowMask, min(pixel, size - 1), 0).r;
    ownBlocked |= drawn ? bits : 0u;
    ownLit |= drawn ? ~bits : 0u;
  }
  atomicOr(blocked, ownBlocked);
  atomicOr(lit, ownLit);
  barrier();
  if (gl_LocalInvocationIndex == 0u)
    tileBits[gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x] = uvec2(blocked, lit);
}
