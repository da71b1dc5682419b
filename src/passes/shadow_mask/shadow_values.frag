// A byte for each layer: how much of its light arrives, by how far behind its blocker a pixel is.
//   ARRAY_LAYERS  four layers in each
//   TILE_LIGHTS   see render/tile_lights.glsl
// variant: ARRAY_LAYERS=3
// variant: ARRAY_LAYERS=8 TILE_LIGHTS=1
#ifndef ARRAY_LAYERS
#define ARRAY_LAYERS 1
#endif
#include "render/layer_lookup.glsl"

uniform float falloff;  // 1/m

layout(location = 0) out uint bytes[ARRAY_LAYERS];  // see render/layered_shadows.hpp

void main() {
  uvec2 pixel = uvec2(gl_FragCoord.xy);
  float shares[4 * ARRAY_LAYERS];
  for (int i = 0; i < 4 * ARRAY_LAYERS; ++i) shares[i] = 1.0;
  uint light = isEmpty(ivec2(pixel)) ? lightCount.x : firstLightAt(pixel);
  // Software rasterisers leave loops early, but run both ways of an if.
  for (bool once = light < lightCount.x; once; once = false) {
    SurfacePixel s = surfaceAt(ivec2(pixel));
    for (; light < lightCount.x; light = lightAfterAt(pixel, light))
      if (mayShadow(light, s)) {
        int layer = lightLayers[light];
        vec3 toLightW = towardsLight(light, s.positionW);
        float share = exponentialVisibility(light, s.positionW, s.planeNormalW, toLightW, falloff);
        shares[layer] = min(shares[layer], share);  // lights of one layer may overlap: see ShadowLayers.variant
      }
  }
  for (int i = 0; i < ARRAY_LAYERS; ++i)
    bytes[i] = packUnorm4x8(vec4(shares[4 * i], shares[4 * i + 1], shares[4 * i + 2], shares[4 * i + 3]));
}
