// What shadow maps (render/shadow_maps.hpp) say of a point: how much of a light reaches it.
//   SHADOW_FILTER  1: percentage-closer filtering, 2: percentage-closer soft shadows; without, a single comparison.
//                  Software rasterisers run what a uniform switches off, too.
//   PLANE_COMPARISON  each of the four depths around a point is compared where it lies on the surface's plane; without,
//                     all of them, or the nearest, with the point's own depth, by the hardware
//   SHADOW_TRANSMISSION  some map sees translucent surfaces, which colour the light
#include "render/lights.glsl"
#include "render/transmittance.glsl"
#include "render/view.glsl"

layout(std430) readonly buffer ShadowMapBlock { ShadowMapValues shadowMaps[]; };
layout(std430) readonly buffer ShadowLightBlock { uvec4 lightShadows[]; };  // first map, count

uniform sampler2DArrayShadow directionalShadowMaps;
uniform sampler2DArrayShadow localShadowMaps;
uniform sampler2DArray directionalShadowDepths;  // the same, as they are
uniform sampler2DArray localShadowDepths;

#ifdef SHADOW_TRANSMISSION
uniform sampler2DArray directionalPaneHalvings;  // of all panes before what is opaque
uniform sampler2DArray localPaneHalvings;
uniform sampler2DArray directionalPaneDepths;    // of the one that is nearest to the light
uniform sampler2DArray localPaneDepths;
#endif

// How far from where it is looked up, in texels along each side, the depths lie that a comparison reads: half a texel
// for the nearest one alone, a whole one for the four of the hardware's mean; by a plane's comparison as far as surfaces
// may bend off it.
uniform float shadowReach = 1.0;
// Percentage-closer filtering (Reeves, Salesin and Cook, SIGGRAPH 1987) over (2 r + 1)^2 comparisons.
uniform int shadowFilterRadius = 0;
// Percentage-closer soft shadows (Fernando, SIGGRAPH 2005 sketches): (2 r + 1)^2 depths are searched for blockers.
uniform int shadowSearchRadius = 2;
// How far a point is moved before it is compared: towards the light in m, and off its surface as a
// factor on what movedForShadow() finds necessary.
uniform float shadowBias = 0.0;
uniform float shadowNormalBias = 0.0;

// Of a position that was found by its depth, as a share of its distance from the eye.
const float kPositionRounding = 2e-5;
// Of depth in a map and of what it is made from, as a share of their range.
const float kMapRounding = 5e-7;

bool isDirectional(ShadowMapValues map) { return map.place.y == 0u; }

// What a texel covers at a point of clip-space w, m.
vec2 texelSize(ShadowMapValues map, float w) { return map.texel.xy * (isDirectional(map) ? vec2(w, w * w) : vec2(w)); }

// A comparison reads the depths of the surface beside the point, which are nearer to the light by up to its reach over
// the map times the surface's slope there. Moved off the surface by reach times the sine of the slope, a plane never
// shadows itself.
vec3 movedForShadow(ShadowMapValues map, float w, vec3 positionW, vec3 normalW, vec3 toLightW) {
  vec2 texel = texelSize(map, w);
  float corner = length(vec2(texel.x + map.texel.w * texel.y, texel.y));
  float cosine = dot(normalW, map.axisW.xyz);
  float sine = sqrt(max(1.0 - cosine * cosine, 0.0));
  float rounding = kPositionRounding * distance(positionW, view.eyeW.xyz);
  float mapRounding = kMapRounding * (length(positionW) + (isDirectional(map) ? map.axisW.w : w));
  return positionW + normalW * (shadowNormalBias * (shadowReach * corner * sine + rounding)) +
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

vec3 uvDepthOf(ShadowMapValues map, vec3 positionW) {
  vec4 clip = map.clipFromWorld * vec4(positionW, 1.0);
  return vec3(0.5 * clip.xy / clip.w + 0.5, depthInMap(map, clip, positionW));
}

// By how much depth changes along the surface's plane, for each unit of u and v: depth's gradient less those of u and v,
// as much of each as leaves nothing along the plane. Gradients are multiplied by clip-space w.
vec2 depthSlope(ShadowMapValues map, vec3 uvDepth, float w, vec3 normalW) {
  mat4 rows = transpose(map.clipFromWorld);
  vec3 u = 0.5 * rows[0].xyz - (uvDepth.x - 0.5) * rows[3].xyz;
  vec3 v = 0.5 * rows[1].xyz - (uvDepth.y - 0.5) * rows[3].xyz;
  vec3 depth = isDirectional(map) ? w * map.depthPlaneW.xyz : rows[2].xyz - uvDepth.z * rows[3].xyz;
  vec3 acrossU = cross(normalW, u);
  float area = dot(acrossU, v);
  vec2 slope = vec2(dot(cross(depth, v), normalW), dot(acrossU, depth));
  return area == 0.0 ? vec2(0.0) : slope / area;
}

// Where the lamps' texture holds a place of a map. Beyond the map's edge all is as at the edge, for another map is
// there; directional maps fill their layers, and beyond them all is lit.
vec3 inLayers(ShadowMapValues map, vec2 uv) {
  float edge = 0.5 * map.texel.z;
  return vec3(map.square.xy + map.square.z * clamp(uv, edge, 1.0 - edge), float(map.place.x));
}

// Depth that a point is compared with beside its own place: its own, or that of its plane where that is nearer to the
// light, so that a plane does not shadow itself; where the plane falls away, another surface that rises there is none
// of the light's way.
vec3 besideIt(vec3 uvDepth, vec2 slope, vec2 offset) {
  return uvDepth + vec3(offset, max(dot(slope, offset), 0.0));
}

#ifdef PLANE_COMPARISON
// In the order of textureGather(), corner: where the four meet.
vec4 fourDepths(ShadowMapValues map, vec2 corner) {
  return isDirectional(map)
             ? textureGather(directionalShadowDepths, vec3(corner, float(map.place.x)))
             : textureGather(localShadowDepths, vec3(map.square.xy + map.square.z * corner, float(map.place.x)));
}

// Planes do not shadow themselves, and need not be moved off for it as far as a texel is wide: what stands off them by
// less still throws its shadow. offset: from the point, in u and v; beyond directional maps all is lit.
float shadowComparison(ShadowMapValues map, vec3 uvDepth, vec2 slope, vec2 offset) {
  vec2 uv = uvDepth.xy + offset, place = uv / map.texel.z - 0.5;
  vec2 first = clamp(floor(place), vec2(0.0), vec2(round(1.0 / map.texel.z) - 2.0));
  vec4 stored = fourDepths(map, (first + 1.0) * map.texel.z);
  vec2 before = offset + (first - place) * map.texel.z, after = before + map.texel.z;
  vec4 rise = slope.x * vec4(before.x, after.x, after.x, before.x) + slope.y * vec4(after.y, after.y, before.y, before.y);
  vec4 lit = vec4(lessThanEqual(stored, uvDepth.z + max(rise, 0.0)));  // as besideIt()
  vec2 part = clamp(place - first, 0.0, 1.0), left = mix(lit.wx, lit.zy, part.x);
  bool beyond = isDirectional(map) && any(greaterThan(abs(uv - 0.5), vec2(0.5)));
  return beyond ? 1.0 : mix(left.x, left.y, part.y);
}
#else
float shadowComparison(ShadowMapValues map, vec3 uvDepth, vec2 slope, vec2 offset) {
  vec3 beside = besideIt(uvDepth, slope, offset);
  return isDirectional(map) ? texture(directionalShadowMaps, vec4(beside.xy, float(map.place.x), beside.z))
                            : texture(localShadowMaps, vec4(inLayers(map, beside.xy), beside.z));
}
#endif

// apart: from one comparison to the next, in u and v.
float filteredShadow(ShadowMapValues map, vec3 uvDepth, vec2 slope, vec2 apart, int radius) {
  float sum = 0.0;
  for (int y = -radius; y <= radius; ++y)
    for (int x = -radius; x <= radius; ++x)
      sum += shadowComparison(map, uvDepth, slope, vec2(x, y) * apart);
  float side = 2.0 * float(radius) + 1.0;
  return sum / (side * side);
}

// Distance from the light along the map's axis, m; of directional lights from some plane across it.
float distanceOf(ShadowMapValues map, float depth) {
  return isDirectional(map) ? (1.0 - depth) * map.axisW.w : map.inner.y / (depth + map.inner.z);
}

float storedDepth(ShadowMapValues map, vec2 uv) {
  return isDirectional(map) ? texture(directionalShadowDepths, vec3(uv, float(map.place.x))).r
                            : texture(localShadowDepths, inLayers(map, uv)).r;
}

// 1 of a light that nothing blocks, and less the farther the blocker is from the point: exp(-falloff m).
float exponentialShadow(ShadowMapValues map, vec3 uvDepth, float falloff) {
  float behind = distanceOf(map, uvDepth.z) - distanceOf(map, storedDepth(map, uvDepth.xy));
  return exp(-falloff * max(behind, 0.0));
}

// To the middle of the texel that is read there, if comparisons are exact about it.
vec2 searchedOffset(ShadowMapValues map, vec2 uv, vec2 offset) {
#ifdef PLANE_COMPARISON
  return (floor((uv + offset) / map.texel.z) + 0.5) * map.texel.z - uv;
#else
  return offset;
#endif
}

// Of what is nearer to the light around a point.
struct Blockers {
  float distance;  // mean of distanceOf()
  float share;     // of what was searched
};
Blockers searchBlockers(ShadowMapValues map, vec3 uvDepth, vec2 slope, vec2 apart) {
  Blockers found = Blockers(0.0, 0.0);
  for (int y = -shadowSearchRadius; y <= shadowSearchRadius; ++y)
    for (int x = -shadowSearchRadius; x <= shadowSearchRadius; ++x) {
      vec3 beside = besideIt(uvDepth, slope, searchedOffset(map, uvDepth.xy, vec2(x, y) * apart));
      float stored = storedDepth(map, beside.xy);
      if (stored <= beside.z) continue;
      found.distance += distanceOf(map, stored);
      found.share += 1.0;
    }
  float side = 2.0 * float(shadowSearchRadius) + 1.0;
  found.distance /= max(found.share, 1.0);
  found.share /= side * side;
  return found;
}

// The width of the penumbra on a surface across the light, m. size: the light's diameter in m, of a directional light
// its full angle's tangent.
float penumbraWidth(ShadowMapValues map, float size, float receiver, float blocker) {
  float behind = max(receiver - blocker, 0.0);
  return isDirectional(map) ? size * behind : size * behind / max(blocker, 1e-4);
}

float lightSize(LightValues light) {
  return light.position.w == 0.0 ? 2.0 * tan(0.5 * light.shape.z) : 2.0 * light.shape.y;
}

// Width on the receiver, m, in which blockers half way to the light lie that hide any of it.
float searchedWidth(ShadowMapValues map, float size, float receiver) {
  return isDirectional(map) ? penumbraWidth(map, size, receiver, 0.5 * receiver) : size;
}

// width: of the penumbra, m.
Blockers blockersOf(ShadowMapValues map, vec3 uvDepth, vec2 slope, float w, float size, out float width) {
  vec2 uvOfMetre = map.texel.z / texelSize(map, w);
  float receiver = distanceOf(map, uvDepth.z);
  vec2 apart = max(0.5 * searchedWidth(map, size, receiver) * uvOfMetre, vec2(map.texel.z)) / max(float(shadowSearchRadius), 1.0);
  Blockers blockers = searchBlockers(map, uvDepth, slope, apart);
  width = blockers.share > 0.0 ? penumbraWidth(map, size, receiver, blockers.distance) : 0.0;
  return blockers;
}

// Comparisons all over the penumbra.
float softShadow(ShadowMapValues map, vec3 uvDepth, vec2 slope, float w, float size) {
  float width;
  Blockers blockers = blockersOf(map, uvDepth, slope, w, size, width);
  vec2 uvOfMetre = map.texel.z / texelSize(map, w), atLeast = vec2(map.texel.z);
  // Software rasterisers leave loops early, but run both ways of an if.
  bool partly = blockers.share > 0.0 && blockers.share < 1.0;
  float visible = filteredShadow(map, uvDepth, slope,
                                 max(0.5 * width * uvOfMetre, atLeast) / max(float(shadowFilterRadius), 1.0),
                                 partly ? shadowFilterRadius : -1);
  return partly ? visible : 1.0 - blockers.share;
}

// Where a light's maps show a point that is moved off its surface.
struct ShadowLookup {
  ShadowMapValues map;
  bool found;
  vec3 positionW;
  vec3 uvDepth;
  float w;  // of clip space
};
ShadowLookup lookUpShadow(uint light, vec3 positionW, vec3 normalW, vec3 toLightW) {
  ShadowLookup at;
  at.found = false;
  if (light >= uint(lightShadows.length())) return at;  // where nobody made maps
  int chosen = shadowMapOf(lightShadows[light], positionW);
  if (chosen < 0) return at;
  at.found = true;
  at.map = shadowMaps[chosen];
  at.w = (at.map.clipFromWorld * vec4(positionW, 1.0)).w;
  at.positionW = movedForShadow(at.map, at.w, positionW, normalW, toLightW);
  at.uvDepth = uvDepthOf(at.map, at.positionW);
  return at;
}

// Share of the light (index as in LightBlock) that arrives, 0 to 1. normalW: of the surface's true
// plane, not of its shading; toLightW: from the point; both unit.
float shadowVisibility(uint light, vec3 positionW, vec3 normalW, vec3 toLightW) {
  ShadowLookup at = lookUpShadow(light, positionW, normalW, toLightW);
  if (!at.found) return 1.0;
#if defined(SHADOW_FILTER) || defined(PLANE_COMPARISON)
  vec2 slope = depthSlope(at.map, at.uvDepth, at.w, normalW);
#else
  const vec2 slope = vec2(0.0);
#endif
#ifndef SHADOW_FILTER
  return shadowComparison(at.map, at.uvDepth, slope, vec2(0.0));
#elif SHADOW_FILTER == 1
  return filteredShadow(at.map, at.uvDepth, slope, vec2(at.map.texel.z), shadowFilterRadius);
#else
  return softShadow(at.map, at.uvDepth, slope, at.w, lightSize(lights[light]));
#endif
}

// falloff: 1/m; see exponentialShadow().
float exponentialVisibility(uint light, vec3 positionW, vec3 normalW, vec3 toLightW, float falloff) {
  ShadowLookup at = lookUpShadow(light, positionW, normalW, toLightW);
  return at.found ? exponentialShadow(at.map, at.uvDepth, falloff) : 1.0;
}

#ifdef SHADOW_TRANSMISSION
float storedPaneDepth(ShadowMapValues map, vec2 uv) {
  return isDirectional(map) ? texture(directionalPaneDepths, vec3(uv, float(map.place.x))).r
                            : texture(localPaneDepths, inLayers(map, uv)).r;
}

// Behind the first pane all of them count.
vec3 storedTransmittance(ShadowMapValues map, vec3 uvDepth) {
  vec3 halvings = isDirectional(map) ? texture(directionalPaneHalvings, vec3(uvDepth.xy, float(map.place.x))).rgb
                                     : texture(localPaneHalvings, inLayers(map, uvDepth.xy)).rgb;
  return storedPaneDepth(map, uvDepth.xy) > uvDepth.z ? afterHalvings(halvings) : vec3(1.0);
}

vec3 filteredTransmittance(ShadowMapValues map, vec3 uvDepth, vec2 slope, vec2 apart, int radius) {
  vec3 sum = vec3(0.0);
  for (int y = -radius; y <= radius; ++y)
    for (int x = -radius; x <= radius; ++x)
      sum += storedTransmittance(map, besideIt(uvDepth, slope, vec2(x, y) * apart));
  float side = 2.0 * float(radius) + 1.0;
  return sum / (side * side);
}

// The width of the penumbra of the panes around a point, m.
float panePenumbra(ShadowMapValues map, vec3 uvDepth, vec2 slope, vec2 uvOfMetre, float size) {
  float receiver = distanceOf(map, uvDepth.z), distance = 0.0, count = 0.0;
  vec2 apart = max(0.5 * searchedWidth(map, size, receiver) * uvOfMetre, vec2(map.texel.z)) /
               max(float(shadowSearchRadius), 1.0);
  for (int y = -shadowSearchRadius; y <= shadowSearchRadius; ++y)
    for (int x = -shadowSearchRadius; x <= shadowSearchRadius; ++x) {
      vec3 beside = besideIt(uvDepth, slope, vec2(x, y) * apart);
      float stored = storedPaneDepth(map, beside.xy);
      if (stored <= beside.z) continue;
      distance += distanceOf(map, stored);
      count += 1.0;
    }
  return count > 0.0 ? penumbraWidth(map, size, receiver, distance / count) : 0.0;
}

// What translucent surfaces let through of the light, filtered as shadowVisibility() is.
vec3 shadowTransmittance(uint light, vec3 positionW, vec3 normalW, vec3 toLightW) {
  ShadowLookup at = lookUpShadow(light, positionW, normalW, toLightW);
  if (!at.found || at.map.place.z == 0u) return vec3(1.0);
#ifdef SHADOW_FILTER
  vec2 slope = depthSlope(at.map, at.uvDepth, at.w, normalW);
  vec2 apart = vec2(at.map.texel.z);
#if SHADOW_FILTER == 2
  vec2 uvOfMetre = at.map.texel.z / texelSize(at.map, at.w);
  float width = panePenumbra(at.map, at.uvDepth, slope, uvOfMetre, lightSize(lights[light]));
  apart = max(0.5 * width * uvOfMetre, apart) / max(float(shadowFilterRadius), 1.0);
#endif
  return filteredTransmittance(at.map, at.uvDepth, slope, apart, shadowFilterRadius);
#else
  return storedTransmittance(at.map, at.uvDepth);
#endif
}
#endif

// The width of the penumbra of what blocks the light, or part of it, m; 0: nothing does.
float penumbraOf(uint light, vec3 positionW, vec3 normalW, vec3 toLightW) {
  ShadowLookup at = lookUpShadow(light, positionW, normalW, toLightW);
  if (!at.found) return 0.0;
  vec2 slope = depthSlope(at.map, at.uvDepth, at.w, normalW);
  float width;
  blockersOf(at.map, at.uvDepth, slope, at.w, lightSize(lights[light]), width);
  return width;
}
