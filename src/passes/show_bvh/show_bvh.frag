// Lines of one colour, whatever the target holds.
#include "render/srgb.glsl"

uniform vec3 lineColor;   // linear, as it shall show on the screen
uniform bool encoded;     // the target holds sRGB-encoded values, not radiance
uniform float exposure;   // what radiance is multiplied by before it shows

layout(location = 0) out vec4 color;

const float kLargestHalf = 65504.0;

void main() {
  vec3 radiance = min(lineColor / exposure, vec3(kLargestHalf));
  color = vec4(encoded ? srgbFromLinear(min(lineColor, vec3(1.0))) : radiance, 1.0);
}
