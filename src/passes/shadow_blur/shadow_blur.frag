// One axis of a separable, anisotropic Gaussian over all layers, at half the size.
//   ARRAY_LAYERS  four layers in each
//   OF_MASK       the first axis, along x: of the mask, of which each tap gathers four pixels; without, the second,
//                 of what the first has left
// variant: ARRAY_LAYERS=1 OF_MASK=1
// variant: ARRAY_LAYERS=8
#ifndef ARRAY_LAYERS
#define ARRAY_LAYERS 1
#endif
#include "render/surface_pixel.glsl"

uniform sampler2DArray penumbrae;  // m
#ifdef OF_MASK
uniform usampler2D shadowMask;
#else
uniform usampler2DArray alongX;
#endif
uniform int taps;             // on either side of the pixel
uniform float maximumRadius;  // px of half the size
uniform float edgeSlope;

layout(location = 0) out uint visibility[ARRAY_LAYERS];  // four layers, a byte each

const int kLayers = 4 * ARRAY_LAYERS;
// The standard deviation of a disc light's penumbra, as a share of its width; and how far a kernel goes, in deviations.
const float kDeviation = 0.25, kReach = 2.2;
// By how much distances differ within a surface, from pixel to pixel, as a share of them.
const float kSameDistance = 0.1;

// By how many pixels of half the size a metre along a direction shifts the point.
vec2 pixelsOfMetre(vec4 clip, vec3 directionV) {
  vec4 shift = view.clipFromView * vec4(directionV, 0.0);
  return 0.25 * view.size.xy * (shift.xy - clip.xy / clip.w * shift.w) / clip.w;
}

// A circle on the surface is an ellipse in the picture. Its Gaussian is one along x and one along a skewed axis after
// another: Geusebroek and Smeulders, "Fast Anisotropic Gauss Filtering", IEEE Transactions on Image Processing 12(8), 2003.
// Returns the axis' step for a deviation of a metre, px.
vec2 axisOf(vec3 positionW, vec3 normalW) {
  vec3 positionV = (view.viewFromWorld * vec4(positionW, 1.0)).xyz;
  vec3 normalV = mat3(view.viewFromWorld) * normalW;
  vec3 along = normalize(abs(normalV.y) < 0.8 ? vec3(normalV.z, 0.0, -normalV.x) : vec3(0.0, -normalV.z, normalV.y));
  vec4 clip = view.clipFromView * vec4(positionV, 1.0);
  vec2 first = pixelsOfMetre(clip, along), second = pixelsOfMetre(clip, cross(normalV, along));
  float xx = first.x * first.x + second.x * second.x;
  float xy = first.x * first.y + second.x * second.y;
  float yy = max(first.y * first.y + second.y * second.y, 1e-12);
#ifdef OF_MASK
  return vec2(sqrt(max(xx - xy * xy / yy, 0.0)), 0.0);
#else
  return sqrt(yy) * vec2(xy / yy, 1.0);
#endif
}

// Distance from the eye's plane, m.
vec4 distancesOf(vec4 reversedDepths) {
  mat4 p = view.viewFromClip;  // (x, y, depth, 1): z and w depend on the depth alone
  return -(p[2][2] * reversedDepths + p[3][2]) / (p[2][3] * reversedDepths + p[3][3]);
}

// Of four pixels, those that show the surface of the one that stands for them.
vec4 sharesOf(vec4 depths, float own) {
  float distance = distancesOf(vec4(own)).x;
  vec4 same = vec4(lessThanEqual(abs(distancesOf(max(depths, 1e-9)) - distance), vec4(kSameDistance * distance)));
  return same / max(dot(same, vec4(1.0)), 1.0);
}

vec4 widthsAt(ivec2 texel, int i) { return texelFetch(penumbrae, ivec3(texel, i), 0); }

void main() {
  ivec2 texel = ivec2(gl_FragCoord.xy), pixel = 2 * texel, last = textureSize(penumbrae, 0).xy - 1;
  if (isEmpty(pixel)) {
    for (int a = 0; a < ARRAY_LAYERS; ++a) visibility[a] = 0xffffffffu;
    return;
  }
  SurfacePixel s = surfaceAt(pixel);
  vec2 axis = axisOf(s.positionW, s.planeNormalW);

  // Taps spread over the widest of the pixel's penumbrae.
  float exponents[kLayers], sums[kLayers], weights[kLayers];
  float widest = 0.0;
  for (int l = 0; l < kLayers; ++l) {
    float deviation = kDeviation * widthsAt(texel, l / 4)[l % 4];  // m
    widest = max(widest, deviation);
    exponents[l] = deviation > 0.0 ? -0.5 / (deviation * deviation) : -1e30;
    sums[l] = weights[l] = 0.0;
  }
  float length1 = max(length(axis), 1e-6);  // px of a metre
  float radius = min(kReach * widest * length1, maximumRadius);
  float apart = max(radius / float(taps), 1.0);  // px
  vec2 direction = axis / length1;
  int end = widest == 0.0 ? 0 : taps;
  for (int i = -end; i <= end; ++i) {
    ivec2 tap = clamp(texel + ivec2(round(float(i) * apart * direction)), ivec2(0), last);
    vec3 away = positionWOf(2 * tap) - s.positionW;
    bool same = i == 0 || (!isEmpty(2 * tap) && abs(dot(away, s.planeNormalW)) <= edgeSlope * length(away));
    float metres = float(i) * apart / length1;
#ifdef OF_MASK
    vec2 corner = (2.0 * vec2(tap) + 1.0) / vec2(textureSize(shadowMask, 0));
    uvec4 bits = textureGather(shadowMask, corner);
    vec4 shares = sharesOf(textureGather(depth, corner), texelFetch(depth, 2 * tap, 0).r);
#endif
    for (int l = 0; l < kLayers; ++l) {
      float weight = same ? exp(exponents[l] * metres * metres) : 0.0;
#ifdef OF_MASK
      uvec4 blocked = bits >> uint(l) & 1u;
      float lit = 1.0 - dot(shares, vec4(blocked));
#else
      float lit = float(texelFetch(alongX, ivec3(tap, l / 4), 0).r >> uint(8 * (l % 4)) & 255u) / 255.0;
#endif
      sums[l] += weight * lit;
      weights[l] += weight;
    }
  }
  for (int a = 0; a < ARRAY_LAYERS; ++a) {
    uint bytes = 0u;
    for (int b = 0; b < 4; ++b)
      bytes |= uint(255.0 * sums[4 * a + b] / max(weights[4 * a + b], 1e-6) + 0.5) << uint(8 * b);
    visibility[a] = bytes;
  }
}
