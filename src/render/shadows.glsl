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
  vec2 texel = map.texel.xy * (map.place.y == 0u ? vec2(w, w * w) : vec2(w));  // m
  float corner = length(vec2(texel.x + map.texel.w * texel.y, texel.y));
  float reach = shadowFilterReach * corner;
  float cosine = dot(normalW, map.axisW.xyz);
  float sine = sqrt(max(1.0 - cosine * cosine, 0.0));
  float off = shadowNormalBias * (reach * sine + kPositionRounding * distance(positionW, view.eyeW.xyz));
  return positionW + normalW * off + toLightW * shadowBias;
}

float depthInMap(ShadowMapValues map, vec4 clip, vec3 positionW) {
  return map.place.y == 0u ? dot(map.depthPlaneW.xyz, positionW) + map.depthPlaneW.w
                           : clip.z / clip.w;
}

// Share of the light (index as in LightBlock) that arrives, 0 to 1. toLightW: unit, from the point.
float shadowVisibility(uint light, vec3 positionW, vec3 normalW, vec3 toLightW) {
  if (light >= uint(lightShadows.length())) return 1.0;  // where nobody made maps
  uvec4 range = lightShadows[light];
  float visibility = 1.0;
  bool found = false;
  // One plain loop that all pixels go through to its end: see shade() of render/shading.glsl.
  for (uint i = range.x; i < range.x + range.y; ++i) {
    vec4 clip = shadowMaps[i].clipFromWorld * vec4(positionW, 1.0);
    bool inside = clip.w > 0.0 && max(abs(clip.x), abs(clip.y)) <= clip.w && clip.z >= 0.0;
    if (found || !inside) continue;
    found = true;
    vec3 movedW = movedForShadow(shadowMaps[i], clip.w, positionW, normalW, toLightW);
    clip = shadowMaps[i].clipFromWorld * vec4(movedW, 1.0);
    visibility = filteredShadow(shadowMaps[i], vec3(0.5 * clip.xy / clip.w + 0.5,
                                                    depthInMap(shadowMaps[i], clip, movedW)));
  }
  return visibility;
}
