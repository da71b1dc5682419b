// What prefiltered shadow maps (render/prefiltered_shadows.hpp) say of a point: how much of a light reaches it.
//   MOMENT_LEVELS  there are levels of wider and wider blur: penumbrae are as wide as the light's size makes them
#include "render/moments.glsl"
#include "render/shadows.glsl"

uniform sampler2DArray directionalMoments;
uniform sampler2DArray localMoments;
uniform float momentTexels;     // of a shadow map, along each side of a texel of moments
uniform float momentDeviation;  // of the places whose depths a tap of level 0 takes together, texels of a shadow map

// Where the moments around a place of a map are.
vec3 momentPlace(ShadowMapValues map, vec2 uv, int textureSide) {
  return vec3(uv / (map.texel.z * momentTexels * float(textureSide)), float(map.place.x));
}

vec4 momentsAt(ShadowMapValues map, vec2 uv, float level) {
  return isDirectional(map)
             ? textureLod(directionalMoments, momentPlace(map, uv, textureSize(directionalMoments, 0).x), level)
             : textureLod(localMoments, momentPlace(map, uv, textureSize(localMoments, 0).x), level);
}

// The range of distances along the map's axis that the moments' depths stand for, m.
float momentRange(ShadowMapValues map) { return isDirectional(map) ? map.axisW.w : map.inner.y / map.inner.z; }

// The standard deviation of the depths of a plane over places that deviate so much, texels; along the map's axis, m.
float planeDeviation(ShadowMapValues map, float w, float deviation, vec3 normalW, vec3 toLightW) {
  vec2 texel = texelSize(map, w);
  float cosine = dot(normalW, map.axisW.xyz);
  float slope = sqrt(max(1.0 - cosine * cosine, 0.0)) * dot(toLightW, map.axisW.xyz) /
                max(abs(dot(normalW, toLightW)), 1e-4);
  return deviation * max(texel.x + map.texel.w * texel.y, texel.y) * slope;
}

#ifdef MOMENT_LEVELS
// The level whose places deviate by so much, texels of the map, or else the first. Each level is the one before, blurred
// by a variance of 3/4 and halved: level l has that of the first and (4^l - 1) / 4 more, in texels of the first; a
// bilinear tap adds 4^l / 6 in the mean, and a mix of two levels that of their variances.
float levelOf(float deviation) {
  float wanted = max(deviation * deviation - momentDeviation * momentDeviation, 0.0) / (momentTexels * momentTexels) /
                 (1.0 / 4.0 + 1.0 / 6.0) + 1.0;
  float whole = floor(0.5 * log2(wanted));
  return whole + (wanted * exp2(-2.0 * whole) - 1.0) / 3.0;
}

// The deviation of a disc's penumbra, texels of the map. The mean blocker is that around the point where the whole light
// sees those half way, as for searchBlockers(); what the point's own plane adds to them is near to it.
float penumbraDeviation(ShadowLookup at, float size, float z) {
  vec2 texel = texelSize(at.map, at.w);
  float texelsOfMetre = inversesqrt(texel.x * texel.y), receiver = distanceOf(at.map, at.uvDepth.z);
  float searched = searchedWidth(at.map, size, receiver);
  const float kFewBlockers = 1e-3;
  const float kOfSquare = 0.288675;  // the deviation of a square of side 1
  vec4 moments = momentsAt(at.map, at.uvDepth.xy, levelOf(kOfSquare * searched * texelsOfMetre));
  DepthsBefore blockers = depthsBefore(moments, z);
  float mean = mix(z, blockers.mean, blockers.share / (blockers.share + kFewBlockers));
  float blocker = 0.5 * (mean + 1.0) * momentRange(at.map);
  return 0.25 * penumbraWidth(at.map, size, receiver, blocker) * texelsOfMetre;
}
#endif

// As shadowVisibility(), with shadowReach 0. The point is taken nearer to the light by the deviation of its plane's
// depths: these then lie a deviation and more behind it, so that with their moments none need be before it.
float prefilteredVisibility(uint light, vec3 positionW, vec3 normalW, vec3 toLightW) {
  ShadowLookup at = lookUpShadow(light, positionW, normalW, toLightW);
  if (!at.found) return 1.0;
  float z = momentDepth(isDirectional(at.map), at.map.inner.z, at.uvDepth.z);
  float deviation = momentDeviation, level = 0.0;
#ifdef MOMENT_LEVELS
  deviation = max(penumbraDeviation(at, lightSize(lights[light]), z), momentDeviation);
  level = levelOf(deviation);
#endif
  float gap = shadowNormalBias * planeDeviation(at.map, at.w, deviation - momentDeviation, normalW, toLightW);
  return 1.0 - depthsBefore(momentsAt(at.map, at.uvDepth.xy, level), z - 2.0 * gap / momentRange(at.map)).share;
}
