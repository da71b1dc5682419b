// What prefiltered shadow maps (render/prefiltered_shadows.hpp) say of a point: how much of a light reaches it.
//   MOMENT_LEVELS  there are levels of wider and wider blur: penumbrae are as wide as the light's size makes them
#include "render/moments.glsl"
#include "render/shadows.glsl"

uniform sampler2DArray directionalMoments;
uniform sampler2DArray localMoments;
uniform float momentTexels;     // of a shadow map, along each side of a texel of moments
uniform float momentDeviation;  // of the places whose depths a lookup in level 0 takes together, texels of a shadow map

// Where the moments around a place of a map are.
vec3 momentPlace(ShadowMapValues map, vec2 uv, int textureSide) {
  return vec3(uv / (map.texel.z * momentTexels * float(textureSide)), float(map.place.x));
}

vec4 momentsAt(ShadowMapValues map, vec2 uv, float level) {
  return isDirectional(map)
             ? textureLod(directionalMoments, momentPlace(map, uv, textureSize(directionalMoments, 0).x), level)
             : textureLod(localMoments, momentPlace(map, uv, textureSize(localMoments, 0).x), level);
}

// Depths before a point around its place in a map. deviation: of that level's places, texels of the map. The point is
// moved off its surface by as much along the map: depths of its own plane then lie a deviation and more behind it, and
// whatever has their moments may have none before it.
DepthsBefore depthsBefore(ShadowLookup at, float deviation, float level, vec3 positionW, vec3 normalW, vec3 toLightW) {
  vec3 movedW = movedForShadow(at.map, at.w, deviation, positionW, normalW, toLightW);
  vec3 uvDepth = uvDepthOf(at.map, movedW);
  float z = momentDepth(isDirectional(at.map), at.map.inner.z, uvDepth.z);
  return depthsBefore(momentsAt(at.map, uvDepth.xy, level), z);
}

#ifdef MOMENT_LEVELS
// Distance along the map's axis as distanceOf(), m.
float distanceOfMoment(ShadowMapValues map, float z) {
  float range = isDirectional(map) ? map.axisW.w : map.inner.y / map.inner.z;
  return 0.5 * (z + 1.0) * range;
}

// The level whose places deviate by so much, texels of the map; and what the first level makes of it. Each level is the
// one before, blurred by a variance of 3/4 and halved: level l has that of the first and (4^l - 1) / 4 more, in texels of
// the first; a bilinear tap adds 4^l / 6 in the mean, and a mix of two levels that of their variances.
float levelOf(inout float deviation) {
  deviation = max(deviation, momentDeviation);
  vec2 variances = vec2(deviation, momentDeviation) / momentTexels;
  variances *= variances;
  float wanted = max((variances.x - variances.y) / (1.0 / 4.0 + 1.0 / 6.0) + 1.0, 1.0);
  float whole = floor(0.5 * log2(wanted));
  return whole + (wanted * exp2(-2.0 * whole) - 1.0) / 3.0;
}
#endif

// As shadowVisibility().
float prefilteredVisibility(uint light, vec3 positionW, vec3 normalW, vec3 toLightW) {
  ShadowLookup at = lookUpShadow(light, positionW, normalW, toLightW);
  if (!at.found) return 1.0;
  float deviation = momentDeviation, level = 0.0;
#ifdef MOMENT_LEVELS
  // Where the whole light sees blockers half way, as searchBlockers(); a square's deviation.
  vec2 texel = texelSize(at.map, at.w);
  float texelsOfMetre = inversesqrt(texel.x * texel.y), size = lightSize(lights[light]);
  float receiver = distanceOf(at.map, uvDepthOf(at.map, positionW).z);
  float searched = isDirectional(at.map) ? penumbraWidth(at.map, size, receiver, 0.5 * receiver) : size;
  deviation = 0.288675 * searched * texelsOfMetre;
  level = levelOf(deviation);
  DepthsBefore blockers = depthsBefore(at, deviation, level, positionW, normalW, toLightW);
  float width = penumbraWidth(at.map, size, receiver, distanceOfMoment(at.map, blockers.mean));
  // The deviation of a disc's penumbra.
  deviation = blockers.share > 1e-3 ? 0.25 * width * texelsOfMetre : 0.0;
  level = levelOf(deviation);
#endif
  return 1.0 - depthsBefore(at, deviation, level, positionW, normalW, toLightW).share;
}
