// Draws depth alone: what shadow maps need of a draw list, holes of alpha-tested materials included.
// Coordinates generated from the eye (eye-linear, sphere-map) are those of the view that is bound: holes made
// by them are elsewhere in a light's view.
//   ALPHA_TEST, TEXTURE_ENVIRONMENT, SHADOW_VIEWS  see render/object_surface.glsl
//   LINEAR_DEPTH  with SHADOW_VIEWS: depth as the view's plane in world space gives it, whatever the projection
// variant: ALPHA_TEST=1
// variant: SHADOW_VIEWS=1 ALPHA_TEST=1 TEXTURE_ENVIRONMENT=1
// variant: SHADOW_VIEWS=1 LINEAR_DEPTH=1
#include "render/object_surface.glsl"

#ifdef LINEAR_DEPTH
layout(location = 7) flat in vec4 depthPlaneW;
#endif

void main() {
#ifdef LINEAR_DEPTH
  gl_FragDepth = dot(depthPlaneW.xyz, positionW) + depthPlaneW.w;
#endif
#ifdef ALPHA_TEST
  testAlpha(materialColor().a);
#endif
}
