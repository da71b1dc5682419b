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

// The points that a texel stands for, on the plane of its first pixel.
struct TexelPoints {
  vec3 middleW;
  vec3 halfX, halfY;  // half a pixel along each axis, m
};
TexelPoints pointsOf(ivec2 pixel, SurfacePixel s) {
  vec3 positionV = (view.viewFromWorld * vec4(s.positionW, 1.0)).xyz;
  vec4 plane = tangentPlaneAt(positionV, mat3(view.viewFromWorld) * s.planeNormalW, 0.0).planeC;
  float farthest = 32.0 * pixelWidthAt(positionV);  // m: else the plane is seen edge on
  vec3 corners[3];  // the middle, and half a pixel beside it
  bool near = scale > 1;
  for (int i = 0; i < 3; ++i) {
    vec2 ndc = ndcOfPixel(vec2(pixel) + 0.5 * float(scale) + 0.5 * vec2(i == 1, i == 2));
    float there = -(dot(plane.xy, ndc) + plane.w) / plane.z;
    corners[i] = worldOfView(positionVOf(ndc, there));
    near = near && distance(corners[i], s.positionW) < farthest;
  }
  if (!near) return TexelPoints(s.positionW, vec3(0.0), vec3(0.0));
  return TexelPoints(corners[0], corners[1] - corners[0], corners[2] - corners[0]);
}

// What panes let through of the light, unfiltered, the mean of four pixels; width: of their penumbra, m.
vec3 hardTransmittance(uint light, TexelPoints points, vec3 normalW, out float width) {
  ShadowLookup at = lookUpShadow(light, points.middleW, normalW, towardsLight(light, points.middleW));
  width = 0.0;
  if (!at.found || at.map.place.z == 0u) return vec3(1.0);
#ifdef NEAREST_BLOCKERS
  width = penumbraOfNearest(light, at);
#else
  vec2 slope = depthSlope(at.map, at.uvDepth, at.w, normalW);
  width = panePenumbra(at.map, at.uvDepth, slope, at.map.texel.z / texelSize(at.map, at.w), lightSize(lights[light]));
#endif
  vec3 alongX = uvDepthOf(at.map, at.positionW + points.halfX) - at.uvDepth;
  vec3 alongY = uvDepthOf(at.map, at.positionW + points.halfY) - at.uvDepth;
  vec3 sum = vec3(0.0);
  int count = scale * scale;
  for (int i = 0; i < count; ++i) {
    vec2 side = vec2(i & 1, i >> 1) * 2.0 - 1.0;
    sum += storedTransmittance(at.map, at.uvDepth + side.x * alongX + side.y * alongY);
  }
  return sum / float(count);
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
    TexelPoints points = pointsOf(ivec2(pixel), s);
    for (; light < lightCount.x; light = lightAfterAt(pixel, light)) {
      int slot = paneSlots[light] - firstSlot;
      bool here = slot >= 0 && slot < 4 * ARRAY_LAYERS && mayLight(lights[light], s.positionW, s.normalW);
      for (; here; here = false) {
        float width;
        vec3 color = hardTransmittance(light, points, s.planeNormalW, width);
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
