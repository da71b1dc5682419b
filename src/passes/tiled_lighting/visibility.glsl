// What both shaders need for shadows: the surface, and the light that reaches it.
//   PREFILTERED_SHADOWS  moments of the maps tell, not the maps; MOMENT_LEVELS: see render/prefiltered_shadows.glsl
//   LAYERED_SHADOWS      screen-space shadows of lights that have a layer; as many array layers
//   LAYERED_TRANSMITTANCE  colours of lights that have a slot for panes; beside SHADOW_TRANSMISSION
//   ALL_IN_LAYERS        all that throw shadows have one: software rasterisers run both ways of an if
#include "render/read_gbuffer.glsl"
#include "render/plane_normal.glsl"
#include "render/shading.glsl"
#include "render/prefiltered_shadows.glsl"
#include "render/shadows.glsl"

// The pixel's, for lightVisibility().
vec3 planeNormalW;

#if defined(LAYERED_SHADOWS) || defined(LAYERED_TRANSMITTANCE)
#include "render/tangent_plane.glsl"

const float kSameSurface = 0.05;  // m off the tangent plane, or as wide as a pixel

// The four texels of layers around a pixel, in the order of textureGather().
struct TexelsAround {
  ivec2 first;   // the least
  vec4 weights;  // by how near they are, of those on the pixel's surface
};
const ivec2 kOffsets[4] = ivec2[](ivec2(0, 1), ivec2(1, 1), ivec2(1, 0), ivec2(0, 0));

// scale, size: px of the picture for each texel, 1 or 2, and texels of it. A texel of half the size lies in the middle
// of the four pixels that it stands for.
TexelsAround texelsAround(ivec2 pixel, vec3 positionW, int scale, ivec2 size) {
  ivec2 texel = scale == 1 ? pixel : (pixel - 1) >> 1;
  vec2 beyond = scale == 1 ? vec2(0.0) : vec2(0.75) - 0.5 * vec2(pixel & 1);  // its first texel
  vec3 positionV = (view.viewFromWorld * vec4(positionW, 1.0)).xyz;
  TangentPlane tangent = tangentPlaneAt(positionV, mat3(view.viewFromWorld) * planeNormalW,
                                        max(kSameSurface, 2.0 * pixelWidthAt(positionV)));
  vec2 before = 1.0 - beyond;
  vec4 weights = vec4(before.x * beyond.y, beyond.x * beyond.y, beyond.x * before.y, before.x * before.y);
  for (int i = 0; i < 4; ++i) {
    ivec2 other = scale * clamp(texel + kOffsets[i], ivec2(0), size - 1);
    weights[i] = onPlane(tangent, other, texelFetch(depth, other, 0).r) ? weights[i] : 0.0;
  }
  return TexelsAround(texel, weights);
}
#endif

#ifdef LAYERED_SHADOWS
#include "render/shadow_layers.glsl"

uniform usampler2D shadowMask;
uniform usampler2DArray layeredShadows;  // four layers in each array layer
uniform int layerScale;                  // px of the picture for each of their texels, 1 or 2

// Share of its light that each layer lets through to the pixel.
float layerShares[4 * LAYERED_SHADOWS];

// From the texels around the pixel; if none is on its surface, the mask's bit.
void readLayers(ivec2 pixel, vec3 positionW) {
  ivec2 size = textureSize(layeredShadows, 0).xy;
  TexelsAround around = texelsAround(pixel, positionW, layerScale, size);
  vec4 weights = around.weights;
  float sum = dot(weights, vec4(1.0));
  uint mask = texelFetch(shadowMask, pixel, 0).r;
  for (int a = 0; a < LAYERED_SHADOWS; ++a) {
    uvec4 found = textureGather(layeredShadows, vec3((vec2(around.first) + 1.0) / vec2(size), a));
    for (int b = 0; b < 4; ++b) {
      float unblocked = float(~mask >> uint(4 * a + b) & 1u);
      uvec4 bytes = found >> uint(8 * b) & 255u;
      vec4 lit = mix(vec4(bytes) / 254.0, vec4(unblocked), equal(bytes, uvec4(255u)));
      layerShares[4 * a + b] = sum > 0.0 ? dot(lit, weights) / sum : unblocked;
    }
  }
}
#endif

#ifdef LAYERED_TRANSMITTANCE
#include "render/layered_transmittance.glsl"
#include "render/pane_slots.glsl"

uniform usampler2DArray layeredTransmittance;  // four slots in each array layer
uniform int paneScale;                         // px of the picture for each of their texels, 1 or 2

TexelsAround paneTexels;  // of the pixel

// What panes let through of the light, from the texels around; if one of them does not know it, what the maps say.
vec3 layeredColor(uint light, vec3 positionW, vec3 toLightW) {
  int slot = paneSlots[light];
  vec3 color = vec3(slot == kNoPanes ? 1.0 : 0.0);
  float sum = color.r;
  bool known = true;
  // Software rasterisers leave loops early, but run both ways of an if.
  for (int i = slot < 0 ? 4 : 0; i < 4; ++i) {
    ivec2 texel = clamp(paneTexels.first + kOffsets[i], ivec2(0), textureSize(layeredTransmittance, 0).xy - 1);
    uint bits = texelFetch(layeredTransmittance, ivec3(texel, slot / 4), 0)[slot % 4];
    float weight = paneTexels.weights[i];
    color += weight * unpackedColor(bits);
    sum += weight;
    known = known && (weight == 0.0 || isKnown(bits));
  }
  color /= max(sum, 1e-6);
  for (bool once = !known || sum == 0.0; once; once = false)
    color = shadowTransmittance(light, positionW, planeNormalW, toLightW);
  return color;
}
#endif

Surface shadowedSurface(ivec2 pixel) {
  Surface s = readSurface(pixel);
  planeNormalW = planeNormalOf(pixel, s.positionW, s.normalW);
#ifdef LAYERED_SHADOWS
  readLayers(pixel, s.positionW);
#endif
#ifdef LAYERED_TRANSMITTANCE
  paneTexels = texelsAround(pixel, s.positionW, paneScale, textureSize(layeredTransmittance, 0).xy);
#endif
  return s;
}

const float kSameFace = 0.5;  // cosine of what a normal for shading leans at most

// What of a light the surface's own plane hides: maps do not tell, where surfaces turn away from the light and depths hardly
// differ. Of a disc of the light's radius, which stands across its axis or, without one, across the way to it.
float shareAboveHorizon(Surface s, LightValues light) {
  vec3 toLight = light.position.xyz - s.positionW * light.position.w;
  // What is a pixel wide has neighbours on other surfaces alone, and through those no plane of its own.
  vec3 ownNormalW = dot(planeNormalW, s.normalW) > kSameFace ? planeNormalW : s.normalW;
  float height = dot(toLight, ownNormalW);
#if defined(LAYERED_SHADOWS) || defined(PREFILTERED_SHADOWS) || SHADOW_FILTER == 2
  bool spot = light.attenuation.w > -1.0;
  vec3 axisW = spot ? light.axis.xyz : normalize(toLight);
  float cosine = dot(ownNormalW, axisW);
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
  vec3 visible = vec3(unblockedShare(s, light, toLightW) * shareAboveHorizon(s, values));
#if defined(LAYERED_TRANSMITTANCE)
  visible *= layeredColor(light, s.positionW, toLightW);
#elif defined(SHADOW_TRANSMISSION)
  visible *= shadowTransmittance(light, s.positionW, planeNormalW, toLightW);
#endif
  return visible;
}
