// The width of each layer's penumbra, at half the size.
//   ARRAY_LAYERS  four layers in each
//   TILE_LIGHTS   see render/tile_lights.glsl
// variant: ARRAY_LAYERS=3
// variant: ARRAY_LAYERS=8 TILE_LIGHTS=1
#ifndef ARRAY_LAYERS
#define ARRAY_LAYERS 1
#endif
#include "render/lights.glsl"
#include "render/normal_encoding.glsl"
#include "render/shadow_layers.glsl"
#include "render/tile_lights.glsl"

uniform sampler2D depth;
uniform sampler2D normal;

#include "render/plane_normal.glsl"
#include "render/shadows.glsl"

layout(location = 0) out vec4 widths[ARRAY_LAYERS];  // m

void main() {
  ivec2 pixel = 2 * ivec2(gl_FragCoord.xy);
  float width[4 * ARRAY_LAYERS];
  for (int i = 0; i < 4 * ARRAY_LAYERS; ++i) width[i] = 0.0;
  // Software rasterisers leave loops early, but run both ways of an if.
  uint end = texelFetch(depth, pixel, 0).r > 0.0 ? lightCount.x : 0u;
  vec3 positionW = positionWOf(pixel);
  vec3 normalW = mat3(view.worldFromView) * decodeNormal(texelFetch(normal, pixel, 0).rg);
  vec3 planeW = planeNormalOf(pixel, positionW, normalW);
  for (uint i = firstLightAt(uvec2(pixel)); i < end; i = lightAfterAt(uvec2(pixel), i)) {
    LightValues light = lights[i];
    int layer = lightLayers[i];
    if (layer < 0 || !mayLight(light, positionW, normalW)) continue;
    vec3 toLightW = normalize(light.position.xyz - positionW * light.position.w);
    width[layer] = penumbraOf(i, positionW, planeW, toLightW);
  }
  for (int i = 0; i < ARRAY_LAYERS; ++i)
    widths[i] = vec4(width[4 * i], width[4 * i + 1], width[4 * i + 2], width[4 * i + 3]);
}
