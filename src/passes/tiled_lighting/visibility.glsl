// What both shaders need for shadows: the surface, and the light that reaches it.
//   PREFILTERED_SHADOWS  moments of the maps tell, not the maps; MOMENT_LEVELS: see render/prefiltered_shadows.glsl
//   LAYERED_SHADOWS      screen-space shadows of lights that have a layer; as many array layers
//   ALL_IN_LAYERS        all that throw shadows have one: software rasterisers run both ways of an if
#include "render/read_gbuffer.glsl"
#include "render/plane_normal.glsl"
#include "render/shading.glsl"
#include "render/prefiltered_shadows.glsl"
#include "render/shadows.glsl"

// The pixel's, for lightVisibility().
vec3 planeNormalW;

#ifdef LAYERED_SHADOWS
#include "render/shadow_layers.glsl"
#include "render/tangent_plane.glsl"

uniform usampler2D shadowMask;
uniform usampler2DArray layeredShadows;  // four layers in each array layer
uniform int layerScale;                  // px of the picture for each of their texels, 1 or 2

const float kSameSurface = 0.05;  // m off the tangent plane, or as wide as a pixel

// Share of its light that each layer lets through to the pixel.
float layerShares[4 * LAYERED_SHADOWS];

// From the four texels around the pixel, those on its surface, weighted by how near they are; if there is none, the
// mask's bit. A texel of half the size lies in the middle of the four pixels that it stands for.
void readLayers(ivec2 pixel, vec3 positionW) {
  ivec2 size = textureSize(layeredShadows, 0).xy, texel = layerScale == 1 ? pixel : (pixel - 1) >> 1;
  vec2 beyond = layerScale == 1 ? vec2(0.0) : vec2(0.75) - 0.5 * vec2(pixel & 1);  // its first texel
  vec3 positionV = (view.viewFromWorld * vec4(positionW, 1.0)).xyz;
  TangentPlane tangent = tangentPlaneAt(positionV, mat3(view.viewFromWorld) * planeNormalW,
                                        max(kSameSurface, 2.0 * pixelWidthAt(positionV)));
  // In the order of textureGather().
  vec2 before = 1.0 - beyond;
  vec4 weights = vec4(before.x * beyond.y, beyond.x * beyond.y, beyond.x * before.y, before.x * before.y);
  ivec2 offsets[4] = ivec2[](ivec2(0, 1), ivec2(1, 1), ivec2(1, 0), ivec2(0, 0));
  for (int i = 0; i < 4; ++i) {
    ivec2 other = layerScale * clamp(texel + offsets[i], ivec2(0), size - 1);
    weights[i] = onPlane(tangent, other, texelFetch(depth, other, 0).r) ? weights[i] : 0.0;
  }
  float sum = dot(weights, vec4(1.0));
  uint mask = texelFetch(shadowMask, pixel, 0).r;
  for (int a = 0; a < LAYERED_SHADOWS; ++a) {
    uvec4 found = textureGather(layeredShadows, vec3((vec2(texel) + 1.0) / vec2(size), a));
    for (int b = 0; b < 4; ++b) {
      float unblocked = float(~mask >> uint(4 * a + b) & 1u);
      uvec4 bytes = found >> uint(8 * b) & 255u;
      vec4 lit = mix(vec4(bytes) / 254.0, vec4(unblocked), equal(bytes, uvec4(255u)));
      layerShares[4 * a + b] = sum > 0.0 ? dot(lit, weights) / sum : unblocked;
    }
  }
}
#endif

Surface shadowedSurface(ivec2 pixel) {
  Surface s = readSurface(pixel);
  planeNormalW = planeNormalOf(pixel, s.positionW, s.normalW);
#ifdef LAYERED_SHADOWS
  readLayers(pixel, s.positionW);
#endif
  return s;
}

// What of a light the surface's own plane hides: maps do not tell, where surfaces turn away from the light and depths hardly
// differ. Of a disc of the light's radius, which stands across its axis or, without one, across the way to it.
float shareAboveHorizon(LightValues light, vec3 positionW) {
  vec3 toLight = light.position.xyz - positionW * light.position.w;
  float height = dot(toLight, planeNormalW);
#if defined(LAYERED_SHADOWS) || defined(PREFILTERED_SHADOWS) || SHADOW_FILTER == 2
  bool spot = light.attenuation.w > -1.0;
  vec3 axisW = spot ? light.axis.xyz : normalize(toLight);
  float cosine = dot(planeNormalW, axisW);
  float upwards = 0.5 * lightSize(light) * sqrt(max(1.0 - cosine * cosine, 0.0));
  float t = clamp(height / max(upwards, 1e-6), -1.0, 1.0);
  return 0.5 + (t * sqrt(1.0 - t * t) + asin(t)) / kPi;
#else
  return step(0.0, height);
#endif
}

// What nothing opaque blocks.
float unblockedShare(Surface s, uint light, vec3 toLightW) {
#ifdef LAYERED_SHADOWS
  int layer = lightLayers[light];
#ifdef ALL_IN_LAYERS
  return layer >= 0 ? layerShares[layer] : 1.0;
#else
  if (layer >= 0) return layerShares[layer];
#endif
#endif
#ifdef PREFILTERED_SHADOWS
  return prefilteredVisibility(light, s.positionW, planeNormalW, toLightW);
#else
  return shadowVisibility(light, s.positionW, planeNormalW, toLightW);
#endif
}

vec3 lightVisibility(Surface s, uint light) {
  LightValues values = lights[light];
  vec3 toLightW = normalize(values.position.xyz - s.positionW * values.position.w);
  vec3 visible = vec3(unblockedShare(s, light, toLightW) * shareAboveHorizon(values, s.positionW));
#ifdef SHADOW_TRANSMISSION
  visible *= shadowTransmittance(light, s.positionW, planeNormalW, toLightW);
#endif
  return visible;
}
