// How wide the penumbra of each layer of screen-space shadows is at a pixel of a G-buffer.
//   ARRAY_LAYERS      four layers in each
//   NEAREST_BLOCKERS  by the minimum filter; without, by a search
//   SHARED_LAYERS     the mean of what lights of one layer have
//   TILE_LIGHTS       see render/tile_lights.glsl
#include "render/layer_lookup.glsl"
#ifdef NEAREST_BLOCKERS
#include "render/nearest_blockers.glsl"
#endif

uniform float sizeTwice;  // 1: widths grow with the square of the light's size

float penumbraAt(uint light, SurfacePixel s) {
  vec3 toLightW = towardsLight(light, s.positionW);
#ifdef NEAREST_BLOCKERS
  float width = penumbraOfNearest(light, s.positionW, s.planeNormalW, toLightW);
#else
  float width = penumbraOf(light, s.positionW, s.planeNormalW, toLightW);
#endif
  return width * mix(1.0, lightSize(lights[light]), sizeTwice);
}

// m; 0 where nothing was drawn.
void findWidths(uvec2 pixel, out float width[4 * ARRAY_LAYERS]) {
  for (int i = 0; i < 4 * ARRAY_LAYERS; ++i) width[i] = 0.0;
#ifdef SHARED_LAYERS
  float blocked = 0.0;
#endif
  uint light = isEmpty(ivec2(pixel)) ? lightCount.x : firstLightAt(pixel);
  // Software rasterisers leave loops early, but run both ways of an if.
  for (bool once = light < lightCount.x; once; once = false) {
    SurfacePixel s = surfaceAt(ivec2(pixel));
    for (; light < lightCount.x; light = lightAfterAt(pixel, light))
      if (mayShadow(light, s)) {
#ifdef SHARED_LAYERS
        float own = penumbraAt(light, s);
        blocked += own > 0.0 ? 1.0 : 0.0;
        width[0] += own;
#else
        width[lightLayers[light]] = penumbraAt(light, s);
#endif
      }
  }
#ifdef SHARED_LAYERS
  width[0] /= max(blocked, 1.0);  // there is no other layer
#endif
}
