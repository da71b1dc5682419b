// What both shaders need for shadows: the surface, and the light that reaches it.
#include "render/read_gbuffer.glsl"
#include "render/plane_normal.glsl"
#include "render/shading.glsl"
#include "render/shadows.glsl"

// The pixel's, for lightVisibility().
vec3 planeNormalW;

Surface shadowedSurface(ivec2 pixel) {
  Surface s = readSurface(pixel);
  planeNormalW = planeNormalOf(pixel, s.positionW, s.normalW);
  return s;
}

float lightVisibility(Surface s, uint light) {
  LightValues values = lights[light];
  vec3 toLightW = normalize(values.position.xyz - s.positionW * values.position.w);
  return shadowVisibility(light, s.positionW, planeNormalW, toLightW);
}
