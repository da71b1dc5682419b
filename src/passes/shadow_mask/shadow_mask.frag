// A bit for each layer whose light is blocked. A layer has at most one light that reaches the pixel.
// variant: TILE_LIGHTS=1
#include "render/lights.glsl"
#include "render/normal_encoding.glsl"
#include "render/shadow_layers.glsl"
#include "render/tile_lights.glsl"

uniform sampler2D depth;
uniform sampler2D normal;

#include "render/plane_normal.glsl"
#include "render/shadows.glsl"

layout(location = 0) out uint mask;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec3 positionW = positionWOf(pixel);
  vec3 normalW = mat3(view.worldFromView) * decodeNormal(texelFetch(normal, pixel, 0).rg);
  vec3 planeW = planeNormalOf(pixel, positionW, normalW);
  mask = 0u;
  for (uint i = firstLightAt(uvec2(pixel)); i < lightCount.x; i = lightAfterAt(uvec2(pixel), i)) {
    LightValues light = lights[i];
    if (lightLayers[i] < 0 || !mayLight(light, positionW, normalW)) continue;
    vec3 toLightW = normalize(light.position.xyz - positionW * light.position.w);
    if (shadowVisibility(i, positionW, planeW, toLightW) < 0.5) mask |= 1u << uint(lightLayers[i]);
  }
}
