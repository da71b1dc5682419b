// What shadow maps (render/shadow_maps.hpp) say of a point: how much of a light reaches it.
#include "render/view.glsl"

layout(std430) readonly buffer ShadowMapBlock { ShadowMapValues shadowMaps[]; };
layout(std430) readonly buffer ShadowLightBlock { uvec4 lightShadows[]; };  // first map, count

uniform sampler2DArrayShadow directionalShadowMaps;
uniform sampler2DArrayShadow localShadowMaps;

// Percentage-closer filtering (Reeves, Salesin and Cook, SIGGRAPH 1987) over (2 r + 1)^2 comparisons
// a texel apart; each is bilinear where the sampler filters.
uniform int shadowFilterRadius = 0;
// How far from the point, in texels along each side, the depths lie that it is compared with: half a
// texel for the nearest one alone, a whole one for the four of the hardware's mean, and the radius.
uniform float shadowFilterReach = 1.0;
// How far a point is moved before it is compared: towards the light in m, and off its surface as a
// factor on what movedForShadow() finds necessary.
uniform float shadowBias = 0.0;
uniform float shadowNormalBias = 0.0;

// Of a position that was found by its depth, as a share of its distance from the eye.
const float kPositionRounding = 2e-5;
// Of depth in a map and of what it is made from, as a share of their range.
const float kMapRounding = 5e-7;

float shadowComparison(ShadowMapValues map, vec3 uvDepth) {
  vec4 at = vec4(uvDepth.xy, float(map.place.x), uvDepth.z);
  return map.place.y == 0u ? texture(directionalShadowMaps, at) : texture(localShadowMaps, at);
}

float filteredShadow(ShadowMapValues map, vec3 uvDepth) {
  float sum = 0.0;
  for (int y = -shadowFilterRadius; y <= shadowFilterRadius; ++y)
    for (int x = -shadowFilterRadius; x <= shadowFilterRadius; ++x)
      sum += shadowComparison(map, uvDepth + vec3(vec2(x, y) * map.texel.z, 0.0));
  float side = 2.0 * float(shadowFilterRadius) + 1.0;
  return sum / (side * side);
}

// A filter compares one depth with those of the surface beside it, which are nearer to the light by up
// to its reach over the map times the surface's slope there. Moved off the surface by reach times the
// sine of the slope, a plane never shadows itself.
vec3 movedForShadow(ShadowMapValues map, float w, vec3 positionW, vec3 normalW, vec3 toLightW) {
  bool directional = map.place.y == 0u;
  vec2 texel = map.texel.xy * (directional ? vec2(w, w * w) : vec2(w));  // m
  float corner = length(vec2(texel.x + map.texel.w * texel.y, texel.y));
  float reach = shadowFilterReach * corner;
  float cosine = dot(normalW, map.axisW.xyz);
  float sine = sqrt(max(1.0 - cosine * cosine, 0.0));
  float rounding = kPositionRounding * distance(positionW, view.eyeW.xyz);
  float mapRounding = kMapRounding * (length(positionW) + (directional ? map.axisW.w : w));
  return positionW + normalW * (shadowNormalBias * (reach * sine + rounding)) +
         toLightW * (shadowBias + mapRounding);
}

float depthInMap(ShadowMapValues map, vec4 clip, vec3 positionW) {
  return map.place.y == 0u ? dot(map.depthPlaneW.xyz, positionW) + map.depthPlaneW.w
                           : clip.z / clip.w;
}

// The light's map to look a point up in, -1: none shows it. The first that is made for it, or else
// one that shows it in its margin, where the filter may meet the border.
int shadowMapOf(uvec4 range, vec3 positionW) {
  int chosen = -1;
  bool chosenInner = false;
  // One plain loop that all pixels go through to its end: see shade() of render/shading.glsl.
  for (uint i = range.x; i < range.x + range.y; ++i) {
    vec4 clip = shadowMaps[i].clipFromWorld * vec4(positionW, 1.0);
    float off = max(abs(clip.x), abs(clip.y));
    bool inside = clip.w > 0.0 && off <= clip.w && clip.z >= 0.0;
    bool inner = inside && off <= shadowMaps[i].inner.x * clip.w;
    if ((inside && chosen < 0) || (inner && !chosenInner)) {
      chosen = int(i);
      chosenInner = inner;
    }
  }
  return chosen;
}

// Share of the light (index as in LightBlock) that arrives, 0 to 1. normalW: of the surface's true
// plane, not of its shading; toLightW: from the point; both unit.
float shadowVisibility(uint light, vec3 positionW, vec3 normalW, vec3 toLightW) {
  if (light >= uint(lightShadows.length())) return 1.0;  // where nobody made maps
  int chosen = shadowMapOf(lightShadows[light], positionW);
  if (chosen < 0) return 1.0;
  ShadowMapValues map = shadowMaps[chosen];
  float w = (map.clipFromWorld * vec4(positionW, 1.0)).w;
  vec3 movedW = movedForShadow(map, w, positionW, normalW, toLightW);
  vec4 clip = map.clipFromWorld * vec4(movedW, 1.0);
  return filteredShadow(map, vec3(0.5 * clip.xy / clip.w + 0.5, depthInMap(map, clip, movedW)));
}
