// One axis of a separable, anisotropic Gaussian over all layers.
//   ARRAY_LAYERS   four layers in each
//   OF_MASK        the first axis, along x: of the mask; without, the second, of what the first has left
//   SHADOW_VALUES  of bytes of layers instead of bits
//   HALF_SIZE      each tap gathers the four pixels of the mask that it stands for
//   SAMPLED_PENUMBRAE  widths are looked up here, not read; with it the macros of render/layer_widths.glsl
//   PUBLISHED      system C as published: circles instead of ellipses, depths compared as they are stored
// variant: ARRAY_LAYERS=1 OF_MASK=1
// variant: ARRAY_LAYERS=2 OF_MASK=1 HALF_SIZE=1
// variant: ARRAY_LAYERS=8 HALF_SIZE=1
// variant: ARRAY_LAYERS=4 OF_MASK=1 SHADOW_VALUES=1
// variant: ARRAY_LAYERS=2 OF_MASK=1 SHADOW_VALUES=1 HALF_SIZE=1
// variant: PUBLISHED=1
// variant: ARRAY_LAYERS=4 OF_MASK=1 HALF_SIZE=1 SAMPLED_PENUMBRAE=1 NEAREST_BLOCKERS=1 TILE_LIGHTS=1
// variant: SAMPLED_PENUMBRAE=1 NEAREST_BLOCKERS=1 SHARED_LAYERS=1
#ifndef ARRAY_LAYERS
#define ARRAY_LAYERS 1
#endif
#include "render/penumbra_blur.glsl"
#include "render/surface_pixel.glsl"
#include "render/tangent_plane.glsl"

#ifdef SAMPLED_PENUMBRAE
#include "render/layer_widths.glsl"
#else
uniform sampler2DArray penumbrae;  // m
uniform int penumbraScale;         // px of the picture for each
#endif
#ifdef SHADOW_VALUES
uniform usampler2DArray shadowValues;  // of the picture's size
#elif defined(OF_MASK)
uniform usampler2D shadowMask;
#else
uniform usampler2DArray alongX;
#endif
uniform int taps;             // on either side of the pixel
uniform float maximumRadius;  // px of the picture
uniform float edgeStop;       // m

layout(location = 0) out uint visibility[ARRAY_LAYERS];  // four layers, a byte each: see render/layered_shadows.hpp

const uint kAsMask = 255u;
const int kLayers = 4 * ARRAY_LAYERS;
const float kPublishedStop = 0.03;    // of stored depth
const float kPublishedCosine = 0.25;  // at least, where a surface is seen at a grazing angle

// See ellipseAxis().
vec3 axisOf(vec3 positionV, vec3 normalV) {
#ifdef OF_MASK
  const bool alongX = true;
#else
  const bool alongX = false;
#endif
#ifdef PUBLISHED
  float w = (view.clipFromView * vec4(positionV, 1.0)).w;
  float across = 0.5 / float(kScale) * view.size.y * view.clipFromView[1][1] / w;
  float shrunk = across * sqrt(max(normalV.z, kPublishedCosine));
  return alongX ? vec3(shrunk, 0.0, shrunk) : vec3(0.0, shrunk, shrunk);
#else
  return ellipseAxis(positionV, normalV, alongX);
#endif
}

// How much of four pixels in a square counts, 1 or 0 each.
vec4 onSurface(TangentPlane t, float ownDepth, ivec2 first, vec4 depths) {
#ifdef PUBLISHED
  return vec4(lessThanEqual(abs(depths - ownDepth), vec4(kPublishedStop)));
#else
  return vec4(onPlaneOfSquare(t, first, depths));
#endif
}

#ifndef SAMPLED_PENUMBRAE
float widthOf(ivec2 pixel, int layer) {  // m
  return texelFetch(penumbrae, ivec3(pixel / penumbraScale, layer / 4), 0)[layer % 4];
}
#endif

// Of layer l, in bytes of four layers.
vec4 shareOf(uvec4 bytes, int l) { return vec4(bytes >> uint(8 * (l % 4)) & 255u) / 255.0; }

// Four layers of a pixel before this axis' blur. Others may blur over it: what has no penumbra itself is as its mask.
uint unblurred(ivec2 pixel, int a) {
#if defined(OF_MASK) && defined(SHADOW_VALUES)
  return texelFetch(shadowValues, ivec3(pixel, a), 0).r;
#elif defined(OF_MASK)
  uint lit = ~texelFetch(shadowMask, pixel, 0).r >> uint(4 * a);
  return 255u * (lit & 1u | (lit & 2u) << 7 | (lit & 4u) << 14 | (lit & 8u) << 21);
#else
  return 0x01010101u * kAsMask;
#endif
}

void main() {
  ivec2 texel = ivec2(gl_FragCoord.xy), pixel = kScale * texel;
  ivec2 picture = textureSize(depth, 0), last = (picture + kScale - 1) / kScale - 1;
  for (int a = 0; a < ARRAY_LAYERS; ++a) visibility[a] = unblurred(pixel, a);
  float widest = 0.0, widths[kLayers];  // m
#ifdef SAMPLED_PENUMBRAE
  float found[kLayers];
  findWidths(uvec2(pixel), found);
#endif
  for (int l = 0; l < kLayers; ++l) {
#ifdef SAMPLED_PENUMBRAE
    widths[l] = found[l];
#else
    widths[l] = widthOf(pixel, l);
#endif
    widest = max(widest, widths[l]);
  }
  // Software rasterisers leave loops early, but run both ways of an if.
  for (bool once = widest > 0.0 && !isEmpty(pixel); once; once = false) {
    SurfacePixel s = surfaceAt(pixel);
    vec3 positionV = (view.viewFromWorld * vec4(s.positionW, 1.0)).xyz;
    vec3 normalV = mat3(view.viewFromWorld) * s.planeNormalW;
    vec3 axis = max(axisOf(positionV, normalV), vec3(-1e6, -1e6, 1e-6));
    float length1 = max(length(axis.xy), 1e-6);  // texels of a metre
    TangentPlane tangent = tangentPlaneAt(positionV, normalV, max(edgeStop, 1.0 / axis.z));
    float ownDepth = texelFetch(depth, pixel, 0).r;

    float exponents[kLayers], ends[kLayers], sums[kLayers], weights[kLayers];
    float inherent = kInherent / (kOfDisc * length1);
    for (int l = 0; l < kLayers; ++l) {
      float squared = max(widths[l] * widths[l] - inherent * inherent, 0.0);
      exponents[l] = gaussianExponent(squared);
      ends[l] = 0.25 * squared;
      sums[l] = weights[l] = 0.0;
    }
    float apart = tapsApart(widest, length1, maximumRadius / float(kScale), taps);
    vec2 direction = axis.xy / length1;
    for (int i = -taps; i <= taps; ++i) {
      ivec2 tap = clamp(texel + ivec2(round(float(i) * apart * direction)), ivec2(0), last);
      float metres = float(i) * apart / length1;
#if defined(OF_MASK) && defined(HALF_SIZE)
      vec2 corner = (2.0 * vec2(tap) + 1.0) / vec2(picture);
#ifndef SHADOW_VALUES
      uvec4 bits = textureGather(shadowMask, corner);
#endif
      vec4 on = onSurface(tangent, ownDepth, 2 * tap, textureGather(depth, corner));
      if (i == 0) on.w = 1.0;
      float share = 0.25 * dot(on, vec4(1.0));
#else
      float tapDepth = texelFetch(depth, kScale * tap, 0).r;
      float share = i == 0 ? 1.0 : onSurface(tangent, ownDepth, kScale * tap, vec4(tapDepth)).w;
#endif
      for (int l = 0; l < kLayers; ++l) {
        float squared = metres * metres;
        float weight = squared <= ends[l] ? share * exp2(exponents[l] * squared) : 0.0;
#ifndef OF_MASK
        float lit = float(texelFetch(alongX, ivec3(tap, l / 4), 0).r >> uint(8 * (l % 4)) & 255u) / 255.0;
        sums[l] += weight * lit;
#elif defined(HALF_SIZE)
#ifdef SHADOW_VALUES
        vec4 blocked = 1.0 - shareOf(textureGather(shadowValues, vec3(corner, l / 4)), l);
#else
        vec4 blocked = vec4(bits >> uint(l) & 1u);
#endif
        sums[l] += weight - weight * dot(on, blocked) / max(4.0 * share, 1.0);
#elif defined(SHADOW_VALUES)
        sums[l] += weight * shareOf(texelFetch(shadowValues, ivec3(tap, l / 4), 0), l).x;
#else
        sums[l] += weight * float(~texelFetch(shadowMask, tap, 0).r >> uint(l) & 1u);
#endif
        weights[l] += weight;
      }
    }
    for (int a = 0; a < ARRAY_LAYERS; ++a) {
      uint bytes = 0u;
      for (int b = 0; b < 4; ++b) {
        int l = 4 * a + b;
        float lit = sums[l] / max(weights[l], 1e-6);
#ifdef OF_MASK
        uint byte = widths[l] > 0.0 ? uint(255.0 * lit + 0.5) : visibility[a] >> uint(8 * b) & 255u;
#else
        bool sharp = kOfDisc * widths[l] * axis.z <= 0.5 * kInherent;
        uint byte = sharp ? kAsMask : uint(254.0 * lit + 0.5);
#endif
        bytes |= byte << uint(8 * b);
      }
      visibility[a] = bytes;
    }
  }
}
