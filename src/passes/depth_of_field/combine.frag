// The sharp picture, and the blurred one where the circle of confusion is larger than a pixel.
#include "passes/depth_of_field/circle.glsl"

uniform sampler2D color;
uniform sampler2D depth;
uniform sampler2D blurred;
uniform vec2 uvOfPixel;  // in `blurred`

layout(location = 0) out vec4 combined;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  float amount = smoothstep(kSharp, 3.0 * kSharp, abs(circleAt(texelFetch(depth, pixel, 0).r)));
  combined = texelFetch(color, pixel, 0);
  if (amount > 0.0) combined.rgb = mix(combined.rgb, texture(blurred, gl_FragCoord.xy * uvOfPixel).rgb, amount);
}
