// Shades one pixel of the G-buffer.
//   AMBIENT_VISIBILITY  see render/read_gbuffer.glsl
// variant: AMBIENT_VISIBILITY=1
#include "render/read_gbuffer.glsl"
#include "render/shading.glsl"

layout(location = 0) out vec4 color;

void main() {
  Surface s = readSurface(ivec2(gl_FragCoord.xy));
  if (s.type == kTypeCustom) discard;  // CustomShaders draws it, before or after
  color = vec4(shade(s), 1.0);
}
