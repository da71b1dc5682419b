// Draws depth alone: what shadow maps need of a draw list, holes of alpha-tested materials included.
//   ALPHA_TEST, TEXTURE_ENVIRONMENT  see render/object_surface.glsl
// variant: ALPHA_TEST=1
#include "render/object_surface.glsl"

void main() {
#ifdef ALPHA_TEST
  testAlpha(materialColor().a);
#endif
}
