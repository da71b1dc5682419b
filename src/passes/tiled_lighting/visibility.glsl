// What both shaders need for shadows: the surface, and the light that reaches it.
//   LAYERED_SHADOWS  screen-space shadows of lights that have a layer
#include "render/read_gbuffer.glsl"
#include "render/plane_normal.glsl"
#include "render/shading.glsl"
#include "render/shadows.glsl"

// The pixel's, for lightVisibility().
vec3 planeNormalW;

#ifdef LAYERED_SHADOWS
#include "render/shadow_layers.glsl"

uniform usampler2D shadowMask;
uniform usampler2DArray layeredShadows;  // at half the size, four layers in each array layer

// Of the four texels around the pixel, those on its surface, weighted by how near they are.
ivec2 texels[4];
vec4 texelWeights;

void findTexels(ivec2 pixel, vec3 positionW) {
  ivec2 last = textureSize(layeredShadows, 0).xy - 1;
  vec2 odd = 0.5 * vec2(pixel & 1);
  vec4 nearness = vec4((1.0 - odd.x) * (1.0 - odd.y), odd.x * (1.0 - odd.y), (1.0 - odd.x) * odd.y, odd.x * odd.y);
  for (int i = 0; i < 4; ++i) {
    texels[i] = min(pixel / 2 + ivec2(i & 1, i >> 1), last);
    vec3 away = positionWOf(2 * texels[i]) - positionW;
    bool same = !isEmpty(2 * texels[i]) && abs(dot(away, planeNormalW)) <= 0.3 * length(away) + 1e-6;
    texelWeights[i] = same ? nearness[i] : 0.0;
  }
}

float layerVisibility(ivec2 pixel, int layer) {
  float weights = dot(texelWeights, vec4(1.0));
  if (weights == 0.0) return (texelFetch(shadowMask, pixel, 0).r >> uint(layer) & 1u) == 0u ? 1.0 : 0.0;
  vec4 found;
  for (int i = 0; i < 4; ++i)
    found[i] = float(texelFetch(layeredShadows, ivec3(texels[i], layer / 4), 0).r >> uint(8 * (layer % 4)) & 255u);
  return dot(found, texelWeights) / (255.0 * weights);
}
#endif

Surface shadowedSurface(ivec2 pixel) {
  Surface s = readSurface(pixel);
  planeNormalW = planeNormalOf(pixel, s.positionW, s.normalW);
#ifdef LAYERED_SHADOWS
  findTexels(pixel, s.positionW);
#endif
  return s;
}

float lightVisibility(Surface s, uint light) {
#ifdef LAYERED_SHADOWS
  if (lightLayers[light] >= 0) return layerVisibility(ivec2(gl_FragCoord.xy), lightLayers[light]);
#endif
  LightValues values = lights[light];
  vec3 toLightW = normalize(values.position.xyz - s.positionW * values.position.w);
  return shadowVisibility(light, s.positionW, planeNormalW, toLightW);
}
