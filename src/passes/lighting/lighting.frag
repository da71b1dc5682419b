// Shades one pixel of the G-buffer.
//   AMBIENT_VISIBILITY  a texture says how much of the ambient light arrives
// variant: AMBIENT_VISIBILITY=1
#include "render/read_gbuffer.glsl"
#include "render/shading.glsl"

#ifdef AMBIENT_VISIBILITY
uniform sampler2D ambientVisibility;
#endif

layout(location = 0) out vec4 color;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  Surface s = readSurface(pixel);
  if (s.type == kTypeCustom) discard;  // CustomShaders draws it, before or after
#ifdef AMBIENT_VISIBILITY
  s.occlusion *= texelFetch(ambientVisibility, pixel, 0).r;
#endif
  color = vec4(shade(s), 1.0);
}
