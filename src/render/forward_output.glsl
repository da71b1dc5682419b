// What is drawn forward leaves behind.
//   TRANSPARENT  opacity and coloured transmittance by dual-source blending (gpu::Blend::Transmit)
#include "render/scene.glsl"
#include "render/transmittance.glsl"

layout(location = 0, index = 0) out vec4 color;
#ifdef TRANSPARENT
layout(location = 0, index = 1) out vec4 transmittance;
#endif

void writeRadiance(vec3 radiance, float alpha) {
#ifdef TRANSPARENT
  float opacity = clamp(alpha, 0.0, 1.0);
  color = vec4(radiance * opacity, 0.0);
  transmittance = vec4(lightThrough(opacity, material.transmission.rgb), 1.0);
#else
  color = vec4(radiance, 1.0);
#endif
}
