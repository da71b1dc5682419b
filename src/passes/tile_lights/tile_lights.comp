// A work group for each tile: first the box around the surfaces that it shows, in world space, then the lights that
// reach into the box, and of those the ones that light some pixel.
//   FACING  surfaces that face away from a light do not count
// variant: FACING=1
#define WRITE_TILE_LIGHTS
#ifdef FACING
#include "render/normal_encoding.glsl"
#endif
#include "render/lights.glsl"
#include "render/tile_lights.glsl"
#include "render/view.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
const uint kThreads = 64u, kWords = kThreads / 32u;  // of lights that are tested together
const uint kPixels = kLightTile / 8u;                // of a thread along each axis
const float kAlmost = 1e-3;                          // what rounding may do to a cosine, and to a distance as a share

uniform sampler2D depth;  // reversed
#ifdef FACING
uniform sampler2D normal;
#endif

// Of the thread's pixels, in world space.
vec3 positions[kPixels * kPixels], normals[kPixels * kPixels];
bool drawn[kPixels * kPixels];

// Corners of the box, as integers of the same order.
shared uint lowest[3];
shared uint highest[3];
shared uint found[kWords];    // lights that may reach the box
shared uint reached[kWords];  // and light a pixel

uint ordered(float value) {
  uint bits = floatBitsToUint(value);
  return (bits & 0x80000000u) != 0u ? ~bits : bits | 0x80000000u;
}
float valueOf(uint ordered) {
  return uintBitsToFloat((ordered & 0x80000000u) != 0u ? ordered & 0x7fffffffu : ~ordered);
}

void growBox(uint thread) {
  if (thread < 3u) {
    lowest[thread] = 0xffffffffu;
    highest[thread] = 0u;
  }
  barrier();
  vec3 low = vec3(1e38), high = vec3(-1e38);
  ivec2 first = ivec2(gl_WorkGroupID.xy * kLightTile + gl_LocalInvocationID.xy * kPixels);
  for (uint i = 0u; i < kPixels * kPixels; ++i) {
    ivec2 pixel = first + ivec2(i % kPixels, i / kPixels), last = textureSize(depth, 0) - 1;
    float reversedDepth = texelFetch(depth, min(pixel, last), 0).r;
    drawn[i] = all(lessThanEqual(pixel, last)) && reversedDepth > 0.0;
    positions[i] = worldOfView(positionVOf(ndcOfPixel(vec2(pixel) + 0.5), max(reversedDepth, 1e-9)));
#ifdef FACING
    normals[i] = mat3(view.worldFromView) * decodeNormal(texelFetch(normal, min(pixel, last), 0).rg);
#endif
    low = min(low, drawn[i] ? positions[i] : low);
    high = max(high, drawn[i] ? positions[i] : high);
  }
  if (low.x <= high.x)
    for (int axis = 0; axis < 3; ++axis) {
      atomicMin(lowest[axis], ordered(low[axis]));
      atomicMax(highest[axis], ordered(high[axis]));
    }
  barrier();
}

// No part of the sphere lies in the cone of directions, of less than a right angle on each side.
bool outsideCone(LightValues light, vec3 centerW, float radius) {
  float cosine = light.attenuation.w;
  if (light.position.w == 0.0 || cosine <= 0.0) return false;
  vec3 toCenter = centerW - light.position.xyz;
  float along = dot(toCenter, light.axis.xyz), squared = dot(toCenter, toCenter);
  float aside = sqrt(max(squared - along * along, 0.0));
  return cosine * aside - sqrt(1.0 - cosine * cosine) * along > radius || along < -radius;
}

bool mayReach(LightValues light, vec3 lowW, vec3 highW) {
  vec3 away = light.position.xyz - clamp(light.position.xyz, lowW, highW);
  bool near = light.position.w == 0.0 || dot(away, away) * light.intensity.w * light.intensity.w < 1.0;
  return near && !outsideCone(light, 0.5 * (lowW + highW), 0.5 * distance(lowW, highW));
}

// mayLight() of render/lights.glsl, of any of the thread's pixels, and a little beyond.
bool mayLightOne(LightValues light) {
  bool some = false;
  for (uint i = 0u; i < kPixels * kPixels; ++i) {
    vec3 toLight = light.position.xyz - positions[i] * light.position.w;
    float squared = dot(toLight, toLight), distance = sqrt(squared);
    bool may = squared * light.intensity.w * light.intensity.w < 1.0 + kAlmost &&
               -dot(toLight, light.axis.xyz) > (light.attenuation.w - kAlmost) * distance;
#ifdef FACING
    may = may && dot(toLight, normals[i]) > -kAlmost * distance;
#endif
    some = some || (may && drawn[i]);
  }
  return some;
}

void main() {
  uint thread = gl_LocalInvocationIndex, words = (lightCount.x + 31u) / 32u;
  uint firstWord = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * words;
  if (firstWord == 0u && thread == 0u) tileGrid = uvec4(gl_NumWorkGroups.x, words, 0u, 0u);
  growBox(thread);
  bool empty = lowest[0] > highest[0];
  vec3 low = vec3(valueOf(lowest[0]), valueOf(lowest[1]), valueOf(lowest[2]));
  vec3 high = vec3(valueOf(highest[0]), valueOf(highest[1]), valueOf(highest[2]));
  float rounding = 1e-5 * max(length(low), length(high));
  for (uint light = 0u; light < lightCount.x; light += kThreads) {
    if (thread < kWords) found[thread] = reached[thread] = 0u;
    barrier();
    uint own = light + thread;
    if (own < lightCount.x && !empty && mayReach(lights[own], low - rounding, high + rounding))
      atomicOr(found[thread / 32u], 1u << (thread % 32u));
    barrier();
    for (uint word = 0u; word < kWords; ++word)
      for (uint bits = found[word]; bits != 0u; bits &= bits - 1u)
        if (mayLightOne(lights[light + 32u * word + uint(findLSB(bits))]))
          atomicOr(reached[word], bits & (~bits + 1u));
    barrier();
    uint word = light / 32u + thread;
    if (thread < kWords && word < words) tileWords[firstWord + word] = reached[thread];
    barrier();
  }
}
