// Exposure, tone curve, sRGB encoding.
#include "render/srgb.glsl"

uniform sampler2D color;
uniform float scale;   // 2^EV
uniform int curve;     // 0 filmic, 1 reinhard, 2 linear, 3 none

layout(location = 0) out vec4 encoded;

// Narkowicz, "ACES Filmic Tone Mapping Curve", 2015: a rational fit, per channel.
vec3 filmic(vec3 x) { return x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14); }

// Reinhard et al., "Photographic Tone Reproduction for Digital Images", 2002, eq. 3, on luminance.
vec3 reinhard(vec3 x) {
  float luminance = dot(x, vec3(0.2126, 0.7152, 0.0722));
  return x / (1.0 + luminance);
}

void main() {
  // Far above what any curve tells from white, and far below where its squares overflow.
  vec3 x = clamp(texelFetch(color, ivec2(gl_FragCoord.xy), 0).rgb * scale, 0.0, 1e6);
  if (curve == 0) x = filmic(x);
  if (curve == 1) x = reinhard(x);
  x = clamp(x, 0.0, 1.0);
  encoded = vec4(curve == 3 ? x : srgbFromLinear(x), 1.0);
}
