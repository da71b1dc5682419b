// Shades one pixel of the G-buffer with shadows.
//   AMBIENT_VISIBILITY  see render/read_gbuffer.glsl
// variant: AMBIENT_VISIBILITY=1
#define LIGHT_VISIBILITY
#include "passes/shadowed_lighting/visibility.glsl"

layout(location = 0) out vec4 color;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  Surface s = shadowedSurface(pixel);
  if (s.type == kTypeCustom) discard;  // darken.frag's
  color = vec4(shade(s), 1.0);
}
