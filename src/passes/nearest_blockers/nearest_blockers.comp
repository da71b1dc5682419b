// A level of the nearest depths (render/nearest_blockers.hpp): a thread for each of its texels.
//   OF_MAPS  level 0, from the maps themselves; without, from the level before
// variant: OF_MAPS=1
layout(local_size_x = 64) in;

uniform sampler2DArray from;
layout(r32f) writeonly uniform image2DArray to;
uniform int level;

#ifdef OF_MAPS
const int kBlock = 8;
#else
const int kBlock = 2;
#endif

void main() {
  ivec3 texel = ivec3(gl_GlobalInvocationID);
  ivec2 size = imageSize(to).xy;
  if (any(greaterThanEqual(texel.xy, size))) return;
#ifdef OF_MAPS
  int fromLevel = 0;
#else
  int fromLevel = level - 1;
#endif
  ivec2 source = textureSize(from, fromLevel).xy;
  ivec2 first = min(texel.xy * kBlock, source - 1), end = min(first + kBlock, source);
  // What is left over beyond the last whole block.
  if (texel.x == size.x - 1) end.x = source.x;
  if (texel.y == size.y - 1) end.y = source.y;
#ifdef OF_MAPS
  // Squares of four; where half of one lies beyond a block it counts, too.
  vec4 four = vec4(0.0);
  for (int y = first.y + 1; y <= end.y; y += 2)
    for (int x = first.x + 1; x <= end.x; x += 2)
      four = max(four, textureGather(from, vec3(vec2(x, y) / vec2(source), texel.z)));
  float nearest = max(max(four.x, four.y), max(four.z, four.w));
#else
  float nearest = 0.0;  // reversed
  for (int y = first.y; y < end.y; ++y)
    for (int x = first.x; x < end.x; ++x)
      nearest = max(nearest, texelFetch(from, ivec3(x, y, texel.z), fromLevel).r);
#endif
  imageStore(to, texel, vec4(nearest));
}
