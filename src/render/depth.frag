// Draws depth alone: what shadow maps need of a draw list, holes of alpha-tested materials included.
// Coordinates generated from the eye (eye-linear, sphere-map) are those of the view that is bound: holes made
// by them are elsewhere in a light's view.
//   ALPHA_TEST, TEXTURE_ENVIRONMENT  see render/object_surface.glsl
// variant: ALPHA_TEST=1
#include "render/object_surface.glsl"

void main() {
#ifdef ALPHA_TEST
  testAlpha(materialColor().a);
#endif
}
