// What prefiltered shadow maps (render/prefiltered_shadows.hpp) say of a point: how much of a light reaches it.
//   MOMENT_LEVELS  there are levels of wider and wider blur: penumbrae are as wide as the light's size makes them
#include "render/moments.glsl"
#include "render/shadows.glsl"

uniform sampler2DArray directionalMoments;
uniform sampler2DArray localMoments;
uniform float momentTexels;     // of a shadow map, along each side of a texel of moments
uniform float momentDeviation;  // of the places whose depths a tap of level 0 takes together, texels of a shadow map

// As in render/prefiltered_shadows.hpp.
const float kCoarsestSide = 8.0;  // texels

// Beyond its edge a map goes on as it is there: taps of a level stay half of its texels inside.
vec4 momentsAt(ShadowMapValues map, vec2 uv, float level) {
  float texel = map.texel.z * momentTexels;  // of level 0
  float coarsest = max(floor(log2(1.0 / (texel * kCoarsestSide)) + 1e-3), 0.0);
  float used = min(level, coarsest), edge = min(0.5 * texel * exp2(ceil(used)), 0.5);
  vec2 inside = clamp(uv, edge, 1.0 - edge);
  // Directional maps fill their layers, which are a little larger than the maps.
  vec2 directional = inside / (texel * float(textureSize(directionalMoments, 0).x));
  vec2 local = map.square.xy + map.square.z * inside;
  return isDirectional(map) ? textureLod(directionalMoments, vec3(directional, float(map.place.x)), used)
                            : textureLod(localMoments, vec3(local, float(map.place.x)), used);
}

#ifdef MOMENT_LEVELS
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

// The level whose places deviate by so much, texels of the map; the first at least. Each level is the one before,
// blurred by a variance of 3/4 and halved: level l has (4^l - 1) / 4 more than the first, in its texels. A bilinear tap
// adds 4^l / 6 in the mean, and a mix of two levels has that of their variances.
float levelOf(float deviation) {
  float more = max(deviation * deviation - momentDeviation * momentDeviation, 0.0) / (momentTexels * momentTexels);
  float power = more / (1.0 / 4.0 + 1.0 / 6.0) + 1.0;  // 4^l
  float whole = floor(0.5 * log2(power));
  return whole + (power * exp2(-2.0 * whole) - 1.0) / 3.0;
}

// The deviation of a disc's penumbra, texels of the map. Blockers are searched in the level as wide as the whole light
// sees those half way, as by searchBlockers(). The point's own plane may count among them.
float penumbraDeviation(ShadowLookup at, float size, float z) {
  const float kOfSquare = 0.288675, kOfDisc = 0.25;  // deviations, as shares of the widths
  const float kFewBlockers = 1e-3;                   // where hardly any are told, their depth is not
  vec2 texel = texelSize(at.map, at.w);
  float texelsOfMetre = inversesqrt(texel.x * texel.y), receiver = distanceOf(at.map, at.uvDepth.z);
  float searched = kOfSquare * searchedWidth(at.map, size, receiver) * texelsOfMetre;
  DepthsBefore blockers = depthsBefore(momentsAt(at.map, at.uvDepth.xy, levelOf(searched)), z);
  float mean = mix(z, blockers.mean, blockers.share / (blockers.share + kFewBlockers));
  float blocker = 0.5 * (mean + 1.0) * momentRange(at.map);
  return kOfDisc * penumbraWidth(at.map, size, receiver, blocker) * texelsOfMetre;
}
#endif

// As shadowVisibility(). shadowReach: momentDeviation. Where a point is moved off its plane by their deviation, the
// plane's depths lie a deviation and more behind it, and with such moments none need be before it. Levels deviate by
// more: for that the point is moved on towards the light, so that a wide penumbra stays in its place.
float prefilteredVisibility(uint light, vec3 positionW, vec3 normalW, vec3 toLightW) {
  ShadowLookup at = lookUpShadow(light, positionW, normalW, toLightW);
  if (!at.found) return 1.0;
  float z = momentDepth(isDirectional(at.map), at.map.inner.z, at.uvDepth.z), level = 0.0;
#ifdef MOMENT_LEVELS
  float deviation = max(penumbraDeviation(at, lightSize(lights[light]), z), momentDeviation);
  level = levelOf(deviation);
  float more = planeDeviation(at.map, at.w, deviation - momentDeviation, normalW, toLightW);
  z -= 2.0 * shadowNormalBias * more / momentRange(at.map);
#endif
  return 1.0 - depthsBefore(momentsAt(at.map, at.uvDepth.xy, level), z).share;
}
