// Looking the pixels of a G-buffer up in the maps of the lights that have a layer
// (render/layer_lookup.hpp).
//   TILE_LIGHTS  see render/tile_lights.glsl
#include "render/lights.glsl"
#include "render/shadow_layers.glsl"
#include "render/shadows.glsl"
#include "render/surface_pixel.glsl"
#include "render/tile_lights.glsl"

// Whether the light has a layer and may light the surface. A layer has at most one such light.
bool mayShadow(uint light, SurfacePixel s) {
  return lightLayers[light] >= 0 && mayLight(lights[light], s.positionW, s.normalW);
}

vec3 towardsLight(uint light, vec3 positionW) {
  return normalize(lights[light].position.xyz - positionW * lights[light].position.w);
}
