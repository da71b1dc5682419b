// The mean light of four by four pixels.
#include "render/srgb.glsl"

uniform sampler2D color;  // sRGB-encoded, four times as large.

layout(location = 0) out vec4 mean;

void main() {
  ivec2 first = 4 * ivec2(gl_FragCoord.xy);
  vec3 sum = vec3(0.0);
  for (int i = 0; i < 16; ++i)
    sum += linearFromSrgb(texelFetch(color, first + ivec2(i % 4, i / 4), 0).rgb);
  mean = vec4(srgbFromLinear(sum / 16.0), 1.0);
}
