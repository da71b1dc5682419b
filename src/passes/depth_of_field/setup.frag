// For setting up the lens: what is in focus is red, the rest the whiter the larger its circle.
#include "passes/depth_of_field/circle.glsl"

uniform sampler2D depth;
uniform float white;

layout(location = 0) out vec4 color;

void main() {
  float circle = abs(circleAt(texelFetch(depth, ivec2(gl_FragCoord.xy), 0).r));
  color = vec4(circle <= kSharp ? vec3(white, 0.0, 0.0) : vec3(white * circle / lens.w), 1.0);
}
