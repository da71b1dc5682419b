// What is nearest to the light around a point of a shadow map (render/nearest_blockers.hpp).
#include "render/shadows.glsl"

uniform sampler2DArray directionalNearestBlockers;
uniform sampler2DArray localNearestBlockers;

const float kNearestBlock = 8.0;  // texels, side of a block of level 0

float nearestBlock(ShadowMapValues map, ivec2 block, int level) {
  ivec3 at = ivec3(block, map.place.x);
  return isDirectional(map) ? texelFetch(directionalNearestBlockers, at, level).r
                            : texelFetch(localNearestBlockers, at, level).r;
}

// Reversed depth of what is nearest to the light within `around` of uv (texels of the map), or at most a block's side
// farther away.
float nearestDepth(ShadowMapValues map, vec2 uv, vec2 around) {
  // Corners of maps lie between blocks, and no level has blocks larger than the map.
  int blocks = max(int(1.0 / (kNearestBlock * map.texel.z) + 1e-3), 1);
  ivec2 corner = ivec2(map.square.xy / map.square.z * float(blocks) + 0.5);
  // Where a block is as wide as the window no more than two lie in it along each side.
  float wide = 2.0 * max(around.x, around.y) / kNearestBlock;
  int level = clamp(int(ceil(log2(max(wide, 1.0)))), 0, findMSB(blocks));
  vec2 texel = uv / map.texel.z;
  float side = kNearestBlock * exp2(float(level));
  ivec2 last = ivec2(blocks >> level) - 1;
  ivec2 from = (corner >> level) + clamp(ivec2(floor((texel - around) / side)), ivec2(0), last);
  ivec2 to = (corner >> level) + clamp(ivec2(floor((texel + around) / side)), ivec2(0), last);
  return max(max(nearestBlock(map, from, level), nearestBlock(map, ivec2(to.x, from.y), level)),
             max(nearestBlock(map, ivec2(from.x, to.y), level), nearestBlock(map, to, level)));
}

// By the minimum filter: the nearest blocker stands for all. at: found.
float penumbraOfNearest(uint light, ShadowLookup at) {
  float size = lightSize(lights[light]), receiver = distanceOf(at.map, at.uvDepth.z);
  vec2 around = 0.5 * searchedWidth(at.map, size, receiver) / texelSize(at.map, at.w);
  float nearest = nearestDepth(at.map, at.uvDepth.xy, around);
  return nearest > at.uvDepth.z ? penumbraWidth(at.map, size, receiver, distanceOf(at.map, nearest)) : 0.0;
}

// As penumbraOf().
float penumbraOfNearest(uint light, vec3 positionW, vec3 normalW, vec3 toLightW) {
  ShadowLookup at = lookUpShadow(light, positionW, normalW, toLightW);
  if (!at.found) return 0.0;
  return penumbraOfNearest(light, at);
}
