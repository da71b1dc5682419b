// Adds what translucent surfaces take away to a shadow map's halvings (render/transmittance.glsl).
//   TEXTURE_ENVIRONMENT, SHADOW_VIEWS  see render/object_surface.glsl
//   LINEAR_DEPTH                       see render/depth.frag
// variant: SHADOW_VIEWS=1
// variant: SHADOW_VIEWS=1 LINEAR_DEPTH=1
#include "render/object_surface.glsl"
#include "render/transmittance.glsl"

#ifdef LINEAR_DEPTH
layout(location = 7) flat in vec4 depthPlaneW;
#endif

layout(location = 0) out vec4 halvings;

void main() {
#ifdef LINEAR_DEPTH
  gl_FragDepth = dot(depthPlaneW.xyz, positionW) + depthPlaneW.w;
#endif
  halvings = vec4(halvingsOf(lightThrough(materialColor().a, material.transmission.rgb)), 0.0);
}
