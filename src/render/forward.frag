// Shades objects as they are drawn, with all lights.
//   ALPHA_TEST   discard below the material's cutoff
//   TRANSPARENT  opacity and coloured transmittance by dual-source blending (gpu::Blend::Transmit)
// variant: ALPHA_TEST=1
// variant: TRANSPARENT=1
#include "render/object_surface.glsl"
#include "render/shading.glsl"

layout(location = 0, index = 0) out vec4 color;
#ifdef TRANSPARENT
layout(location = 0, index = 1) out vec4 transmittance;
#endif

void main() {
  vec4 baseColor = materialColor();
#ifdef ALPHA_TEST
  if (baseColor.a < material.transmission.w) discard;
#endif
  vec3 radiance = shade(surfaceOf(baseColor));
#ifdef TRANSPARENT
  // transmittance() of scene/material.hpp.
  float opacity = clamp(baseColor.a, 0.0, 1.0);
  color = vec4(radiance * opacity, 0.0);
  transmittance = vec4((1.0 - opacity) * material.transmission.rgb, 1.0);
#else
  color = vec4(radiance, 1.0);
#endif
}
