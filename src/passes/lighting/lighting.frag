// Shades one pixel of the G-buffer.
#include "render/read_gbuffer.glsl"
#include "render/shading.glsl"

layout(location = 0) out vec4 color;

void main() {
  Surface s = readSurface(ivec2(gl_FragCoord.xy));
  // A custom shader draws its pixels itself.
  color = vec4(s.type == kTypeCustom ? s.emissive : shade(s), 1.0);
}
