// The sRGB transfer function (IEC 61966-2-1), for values in [0, 1].
vec3 srgbFromLinear(vec3 x) {
  return mix(12.92 * x, 1.055 * pow(max(x, 0.0031308), vec3(1.0 / 2.4)) - 0.055,
             greaterThan(x, vec3(0.0031308)));
}

vec3 linearFromSrgb(vec3 x) {
  return mix(x / 12.92, pow((max(x, 0.04045) + 0.055) / 1.055, vec3(2.4)),
             greaterThan(x, vec3(0.04045)));
}
