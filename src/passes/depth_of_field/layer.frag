// The light of wide circles on one side of the plane in focus, smoothed along one axis for being read in strides.
// variant: OF_PICTURE=1
#include "passes/depth_of_field/grid.glsl"

uniform float side;  // -1: before the plane in focus; 1: behind it
uniform ivec2 direction;
uniform sampler2D source;  // the picture, or what is smoothed along the other axis
#ifdef OF_PICTURE
uniform sampler2D depth;
#else
uniform sampler2D cover;
#endif

layout(location = 0) out vec4 smoothed;  // rgb; a: radius of its circle, px
layout(location = 1) out float covered;  // share of the pixel whose light it is

struct Light {
  vec3 color;
  float radius;  // px
  float cover;
};
Light lightAt(ivec2 pixel) {
  vec4 found = texelFetch(source, pixel, 0);
#ifdef OF_PICTURE
  float radius = side * circleAt(texelFetch(depth, pixel, 0).r);
  return Light(finite(found.rgb), radius, isWide(radius) ? 1.0 : 0.0);
#else
  return Light(found.rgb, found.a, texelFetch(cover, pixel, 0).r);
#endif
}

// Rises towards the eye, in both directions: before the plane in focus what is nearest has the largest circle,
// behind it the smallest.
float nearness(float radius) { return side < 0.0 ? radius : 1.0 / max(radius, kSharp); }
float radiusOf(float nearness) { return side < 0.0 ? nearness : 1.0 / nearness; }

// A pixel's light is spread over a tent.
float shareOf(Light light, float away, float stride) {
  return light.cover / stride * max(1.0 - away / stride, 0.0);
}

void main() {
  smoothed = vec4(0.0);
  covered = 0.0;
  ivec2 pixel = ivec2(gl_FragCoord.xy), last = textureSize(source, 0) - 1;
  vec2 most = largestAt(pixel);
  if (!isWide(side < 0.0 ? most.x : most.y)) return;
  float stride = widestStride(pixel);
  int reach = int(stride) - 1;

  float foremost = 0.0;
  for (int i = -reach; i <= reach; ++i) {
    Light light = lightAt(clamp(pixel + i * direction, ivec2(0), last));
    if (shareOf(light, abs(float(i)), stride) > 0.0) foremost = max(foremost, nearness(light.radius));
  }
  if (foremost == 0.0) return;
  // There is room for one circle: what is far behind the foremost is left out.
  for (int i = -reach; i <= reach; ++i) {
    Light light = lightAt(clamp(pixel + i * direction, ivec2(0), last));
    float share = shareOf(light, abs(float(i)), stride) *
                  smoothstep(0.5, 0.75, nearness(light.radius) / foremost);
    smoothed.rgb += share * light.color;
    covered += share;
  }
  smoothed.rgb /= covered;
  smoothed.a = radiusOf(foremost);
#ifndef OF_PICTURE
  smoothed.a = unsmoothed(smoothed.a, stride);
#endif
}
