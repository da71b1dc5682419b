// What panes let through at each pixel of the light of some slots, hard, and how wide their penumbrae are.
//   ARRAY_LAYERS      four slots in each, at most four
//   NEAREST_BLOCKERS  widths by the nearest pane, the samplers of render/nearest_blockers.glsl being those of panes;
//                     without, by a search
//   TILE_LIGHTS       see render/tile_lights.glsl
// variant: TILE_LIGHTS=1
// variant: ARRAY_LAYERS=4 TILE_LIGHTS=1 NEAREST_BLOCKERS=1
#ifndef ARRAY_LAYERS
#define ARRAY_LAYERS 1
#endif
#define SHADOW_TRANSMISSION
#include "render/layer_lookup.glsl"
#include "render/layered_transmittance.glsl"
#ifdef NEAREST_BLOCKERS
#include "render/nearest_blockers.glsl"
#endif
#include "render/pane_slots.glsl"
#include "render/tangent_plane.glsl"

uniform int scale;      // px of the picture for each
uniform int firstSlot;  // of those that are asked for

layout(location = 0) out uvec4 colors[ARRAY_LAYERS];
layout(location = ARRAY_LAYERS) out vec4 widths[ARRAY_LAYERS];  // m

// In the middle of the pixels that the texel stands for, on the plane of their first.
vec3 middleOf(ivec2 pixel, SurfacePixel s) {
  vec3 positionV = (view.viewFromWorld * vec4(s.positionW, 1.0)).xyz;
  vec4 plane = tangentPlaneAt(positionV, mat3(view.viewFromWorld) * s.planeNormalW, 0.0).planeC;
  vec2 ndc = ndcOfPixel(vec2(pixel) + 0.5 * float(scale));
  float own = texelFetch(depth, pixel, 0).r, there = -(dot(plane.xy, ndc) + plane.w) / plane.z;
  bool near = abs(there - own) < 0.1 * own;  // or the plane is seen edge on
  return scale > 1 && near ? worldOfView(positionVOf(ndc, there)) : s.positionW;
}

// What panes let through of the light, unfiltered; width: of their penumbra, m.
vec3 hardTransmittance(uint light, vec3 positionW, vec3 normalW, out float width) {
  ShadowLookup at = lookUpShadow(light, positionW, normalW, towardsLight(light, positionW));
  width = 0.0;
  if (!at.found || at.map.place.z == 0u) return vec3(1.0);
#ifdef NEAREST_BLOCKERS
  width = penumbraOfNearest(light, at);
#else
  vec2 slope = depthSlope(at.map, at.uvDepth, at.positionW, normalW, texelSize(at.map, at.w).x);
  width = panePenumbra(at.map, at.uvDepth, slope, at.map.texel.z / texelSize(at.map, at.w), lightSize(lights[light]));
#endif
  return storedTransmittance(at.map, at.uvDepth);
}

void main() {
  uvec2 pixel = uint(scale) * uvec2(gl_FragCoord.xy);
  for (int a = 0; a < ARRAY_LAYERS; ++a) {
    colors[a] = uvec4(0u);
    widths[a] = vec4(0.0);
  }
  uint light = isEmpty(ivec2(pixel)) ? lightCount.x : firstLightAt(pixel);
  // Software rasterisers leave loops early, but run both ways of an if.
  for (bool once = light < lightCount.x; once; once = false) {
    SurfacePixel s = surfaceAt(ivec2(pixel));
    vec3 positionW = middleOf(ivec2(pixel), s);
    for (; light < lightCount.x; light = lightAfterAt(pixel, light)) {
      int slot = paneSlots[light] - firstSlot;
      bool here = slot >= 0 && slot < 4 * ARRAY_LAYERS && mayLight(lights[light], s.positionW, s.normalW);
      for (; here; here = false) {
        float width;
        vec3 color = hardTransmittance(light, positionW, s.planeNormalW, width);
        uint bits = packedColor(color);
        for (int a = 0; a < ARRAY_LAYERS; ++a) {
          bvec4 own = equal(ivec4(slot), 4 * a + ivec4(0, 1, 2, 3));
          colors[a] = mix(colors[a], uvec4(bits), own);
          widths[a] = mix(widths[a], vec4(width), own);
        }
      }
    }
  }
}
