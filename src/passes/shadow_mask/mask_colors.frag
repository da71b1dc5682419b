// The bits of the mask as colours: each layer a hue, those of several mixed. For the figure of the page.
uniform usampler2D shadowMask;
uniform sampler2D depth;  // Reversed.

layout(location = 0) out vec4 shown;

vec3 hueOf(int layer) {
  float turn = 6.2832 * fract(0.618034 * float(layer));
  return 0.5 + 0.5 * cos(turn + vec3(0.0, 2.0944, 4.1888));
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  uint bits = texelFetch(shadowMask, pixel, 0).r;
  vec3 sum = vec3(0.0);
  for (int layer = 0; layer < 32; ++layer)
    if ((bits >> layer & 1u) != 0u) sum += hueOf(layer);
  bool nothing = texelFetch(depth, pixel, 0).r == 0.0;
  shown = vec4(bits == 0u ? vec3(nothing ? 0.0 : 0.9) : sum / float(bitCount(bits)), 1.0);
}
