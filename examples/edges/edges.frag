// Ink lines over the picture where depth jumps or surfaces meet at an angle.
#include "render/normal_encoding.glsl"

uniform sampler2D color;   // The picture to draw on.
uniform sampler2D depth;   // Reversed depth.
uniform sampler2D normal;  // View space, octahedral.

uniform vec3 ink = vec3(0.0);     // color: of the lines.
uniform float jump = 0.02;        // 0 to 1: relative change of depth that makes a line.
uniform float crease = 30.0;      // 0 to 180 deg: angle between surfaces that makes a line.

layout(location = 0) out vec4 drawn;

float depthAt(ivec2 pixel) { return texelFetch(depth, pixel, 0).r; }
vec3 normalAt(ivec2 pixel) { return decodeNormal(texelFetch(normal, pixel, 0).rg); }

// Whether there is a line between the two neighbours of a pixel. The depth of a plane is linear on
// the screen, so that its second difference is zero, however steeply the plane is seen.
bool isLine(ivec2 pixel, ivec2 step) {
  ivec2 last = textureSize(depth, 0) - 1;
  ivec2 a = clamp(pixel - step, ivec2(0), last), b = clamp(pixel + step, ivec2(0), last);
  float middle = depthAt(pixel);
  float curve = abs(depthAt(a) + depthAt(b) - 2.0 * middle);
  if (curve > jump * middle) return true;
  return middle > 0.0 && dot(normalAt(a), normalAt(b)) < cos(radians(crease));
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  bool line = isLine(pixel, ivec2(1, 0)) || isLine(pixel, ivec2(0, 1));
  vec3 picture = texelFetch(color, pixel, 0).rgb;
  drawn = vec4(line ? ink : picture, 1.0);
}
