// The width of each layer's penumbra, at half the size.
//   ARRAY_LAYERS  four layers in each
//   TILE_LIGHTS   see render/tile_lights.glsl
// variant: ARRAY_LAYERS=3
// variant: ARRAY_LAYERS=8 TILE_LIGHTS=1
#ifndef ARRAY_LAYERS
#define ARRAY_LAYERS 1
#endif
#include "render/layer_lookup.glsl"

layout(location = 0) out vec4 widths[ARRAY_LAYERS];  // m

void main() {
  uvec2 pixel = 2u * uvec2(gl_FragCoord.xy);
  float width[4 * ARRAY_LAYERS];
  for (int i = 0; i < 4 * ARRAY_LAYERS; ++i) width[i] = 0.0;
  // Software rasterisers leave loops early, but run both ways of an if.
  uint end = isEmpty(ivec2(pixel)) ? 0u : lightCount.x;
  SurfacePixel s = surfaceAt(ivec2(pixel));
  for (uint i = firstLightAt(pixel); i < end; i = lightAfterAt(pixel, i))
    if (mayShadow(i, s))
      width[lightLayers[i]] = penumbraOf(i, s.positionW, s.planeNormalW, towardsLight(i, s.positionW));
  for (int i = 0; i < ARRAY_LAYERS; ++i)
    widths[i] = vec4(width[4 * i], width[4 * i + 1], width[4 * i + 2], width[4 * i + 3]);
}
