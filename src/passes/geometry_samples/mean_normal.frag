// The mean of the normals of a pixel's samples, as ShowGBuffer shows normals. For the figure of the page.
#include "render/normal_encoding.glsl"

uniform sampler2DMS depthSamples;   // Reversed.
uniform sampler2DMS normalSamples;  // View space, octahedral.

layout(location = 0) out vec4 shown;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  shown = vec4(0.0, 0.0, 0.0, 1.0);
  for (int i = 0; i < 4; ++i) {
    if (texelFetch(depthSamples, pixel, i).r == 0.0) continue;
    vec3 n = decodeNormal(texelFetch(normalSamples, pixel, i).rg);
    shown.rgb += 0.25 * (0.5 + 0.5 * n);
  }
}
