// A work group for each tile: first the box around the surfaces that it shows, in world space, then the lights that
// reach into the box.
#define WRITE_TILE_LIGHTS
#include "render/lights.glsl"
#include "render/tile_lights.glsl"
#include "render/view.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
const uint kThreads = 64u, kPixels = kLightTile / 8u;  // pixels of a thread along each axis

uniform sampler2D depth;  // reversed

// Corners of the box, as integers of the same order.
shared uint lowest[3];
shared uint highest[3];
shared uint found[kThreads / 32u];  // of the lights that are tested together

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
    ivec2 pixel = first + ivec2(i % kPixels, i / kPixels);
    if (any(greaterThanEqual(pixel, textureSize(depth, 0)))) continue;
    float reversedDepth = texelFetch(depth, pixel, 0).r;
    if (reversedDepth == 0.0) continue;
    vec3 positionW = worldOfView(positionVOf(ndcOfPixel(vec2(pixel) + 0.5), reversedDepth));
    low = min(low, positionW);
    high = max(high, positionW);
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
    if (thread < kThreads / 32u) found[thread] = 0u;
    barrier();
    uint own = light + thread;
    if (own < lightCount.x && !empty && mayReach(lights[own], low - rounding, high + rounding))
      atomicOr(found[thread / 32u], 1u << (thread % 32u));
    barrier();
    uint word = light / 32u + thread;
    if (thread < kThreads / 32u && word < words) tileWords[firstWord + word] = found[thread];
    barrier();
  }
}
