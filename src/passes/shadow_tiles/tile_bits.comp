// A work group for each tile: the layers that are blocked at some pixel, in part with SHADOW_VALUES, and those that are
// not at some.
//   SHADOW_VALUES  by the bytes of each layer in place of its bit
// variant: SHADOW_VALUES=1
layout(local_size_x = 8, local_size_y = 8) in;
const ivec2 kPixels = ivec2(2);  // of a thread: tiles are those of render/tile_lights.glsl

#ifdef SHADOW_VALUES
uniform usampler2DArray shadowValues;  // four layers in each array layer
uniform int arrayLayers;
#else
uniform usampler2D shadowMask;
#endif
uniform sampler2D depth;  // reversed

layout(std430) writeonly buffer TileBitBlock { uvec2 tileBits[]; };

shared uint blocked, lit;

// Layers that are blocked at a pixel, and that are lit.
uvec2 bitsAt(ivec2 pixel) {
#ifdef SHADOW_VALUES
  uvec2 bits = uvec2(0u);
  for (int layer = 0; layer < 4 * arrayLayers; ++layer) {
    uint byte = texelFetch(shadowValues, ivec3(pixel, layer / 4), 0).r >> uint(8 * (layer % 4)) & 255u;
    bits |= uvec2(byte < 255u, byte > 0u) << uint(layer);
  }
  return bits;
#else
  uint bits = texelFetch(shadowMask, pixel, 0).r;
  return uvec2(bits, ~bits);
#endif
}

void main() {
  if (gl_LocalInvocationIndex == 0u) blocked = lit = 0u;
  barrier();
  ivec2 first = ivec2(gl_GlobalInvocationID.xy) * kPixels, size = textureSize(depth, 0);
  uint ownBlocked = 0u, ownLit = 0u;
  for (int i = 0; i < kPixels.x * kPixels.y; ++i) {
    ivec2 pixel = first + ivec2(i % kPixels.x, i / kPixels.x);
    bool drawn = all(lessThan(pixel, size)) && texelFetch(depth, min(pixel, size - 1), 0).r > 0.0;
    uvec2 bits = bitsAt(min(pixel, size - 1));
    ownBlocked |= drawn ? bits.x : 0u;
    ownLit |= drawn ? bits.y : 0u;
  }
  atomicOr(blocked, ownBlocked);
  atomicOr(lit, ownLit);
  barrier();
  if (gl_LocalInvocationIndex == 0u)
    tileBits[gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x] = uvec2(blocked, lit);
}
