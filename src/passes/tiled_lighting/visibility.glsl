// What both shaders need for shadows: the surface, and the light that reaches it.
#include "render/read_gbuffer.glsl"
#include "render/shading.glsl"
#include "render/shadows.glsl"

vec3 positionWOf(ivec2 pixel) {
  float reversedDepth = max(texelFetch(depth, pixel, 0).r, 1e-30);
  return worldOfView(positionVOf(ndcOfPixel(vec2(pixel) + 0.5), reversedDepth));
}

// The way along the surface from the pixel to one of two opposite neighbours: to the one that is more
// across the shading normal, for the other may show another surface.
vec3 alongSurface(Surface s, ivec2 pixel, ivec2 side) {
  ivec2 last = textureSize(depth, 0) - 1;
  vec3 forward = positionWOf(clamp(pixel + side, ivec2(0), last)) - s.positionW;
  vec3 backward = s.positionW - positionWOf(clamp(pixel - side, ivec2(0), last));
  // Beyond the picture's edge there is no neighbour.
  float a = dot(forward, forward), b = dot(backward, backward);
  float offA = a > 0.0 ? abs(dot(forward, s.normalW)) * inversesqrt(a) : 2.0;
  float offB = b > 0.0 ? abs(dot(backward, s.normalW)) * inversesqrt(b) : 2.0;
  return offA <= offB ? forward : backward;
}

// The normal of the plane through the pixel and its neighbours: shading normals lean, and a plane
// moved off along them would shadow itself.
vec3 trueNormalW(Surface s, ivec2 pixel) {
  vec3 normalW = cross(alongSurface(s, pixel, ivec2(1, 0)), alongSurface(s, pixel, ivec2(0, 1)));
  float squared = dot(normalW, normalW);
  return squared > 0.0 ? normalW * inversesqrt(squared) : s.normalW;
}

// The pixel's, for lightVisibility().
vec3 planeNormalW;

Surface shadowedSurface(ivec2 pixel) {
  Surface s = readSurface(pixel);
  planeNormalW = trueNormalW(s, pixel);
  return s;
}

float lightVisibility(Surface s, uint light) {
  LightValues values = lights[light];
  vec3 toLightW = normalize(values.position.xyz - s.positionW * values.position.w);
  return shadowVisibility(light, s.positionW, planeNormalW, toLightW);
}
