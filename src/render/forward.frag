// Shades objects as they are drawn, with all lights.
//   ALPHA_TEST, TEXTURE_ENVIRONMENT  see render/object_surface.glsl
//   BAKED_LIGHT                      see render/surface.glsl
//   TRANSPARENT                      see render/forward_output.glsl
// variant: ALPHA_TEST=1
// variant: TEXTURE_ENVIRONMENT=1
// variant: BAKED_LIGHT=1
// variant: TRANSPARENT=1
#include "render/forward_output.glsl"
#include "render/object_surface.glsl"
#include "render/shading.glsl"

void main() {
  vec4 baseColor = materialColor();
  testAlpha(baseColor.a);
  writeRadiance(shade(surfaceOf(baseColor)), baseColor.a);
}
