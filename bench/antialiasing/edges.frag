// Whether depth jumps or surfaces meet at an angle among four by four pixels.
#include "render/view.glsl"

uniform sampler2D depth;    // Reversed, four times as large.
uniform float jump = 0.5;   // 0 to 100 px: change of distance from pixel to pixel, beside a plane's, that is an edge.

layout(location = 0) out vec4 edge;

// Depth is linear over a plane and its second difference 0; it falls with the distance as pixels grow with it.
bool isEdge(ivec2 pixel, ivec2 unit) {
  ivec2 last = textureSize(depth, 0) - 1;
  float a = texelFetch(depth, clamp(pixel - unit, ivec2(0), last), 0).r;
  float b = texelFetch(depth, clamp(pixel + unit, ivec2(0), last), 0).r;
  float middle = texelFetch(depth, pixel, 0).r;
  float pixelAngle = 2.0 * view.size.w / view.clipFromView[1][1];
  return abs(a + b - 2.0 * middle) > jump * pixelAngle * middle;
}

void main() {
  ivec2 first = 4 * ivec2(gl_FragCoord.xy);
  bool found = false;
  for (int i = 0; i < 16; ++i) {
    ivec2 pixel = first + ivec2(i % 4, i / 4);
    found = found || isEdge(pixel, ivec2(1, 0)) || isEdge(pixel, ivec2(0, 1));
  }
  edge = vec4(vec3(found ? 1.0 : 0.0), 1.0);
}
