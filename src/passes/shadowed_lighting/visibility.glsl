// What both shaders of ShadowedLighting need: the surface, and the light that reaches it.
#include "render/read_gbuffer.glsl"
#include "render/shading.glsl"
#include "render/shadows.glsl"

#ifdef AMBIENT_VISIBILITY
uniform sampler2D ambientVisibility;
#endif

Surface shadowedSurface(ivec2 pixel) {
  Surface s = readSurface(pixel);
#ifdef AMBIENT_VISIBILITY
  s.occlusion *= texelFetch(ambientVisibility, pixel, 0).r;
#endif
  return s;
}

float lightVisibility(Surface s, uint light) {
  LightValues values = lights[light];
  vec3 toLightW = normalize(values.position.xyz - s.positionW * values.position.w);
  return shadowVisibility(light, s.positionW, s.normalW, toLightW);
}
