// What blurs that soften hard shadows in the picture have in common: a Gaussian that is a circle on each pixel's surface,
// one axis after another, cut off where the penumbra ends.
//   HALF_SIZE  a texel stands for two pixels of the picture along each axis
#include "render/view.glsl"

#ifdef HALF_SIZE
const int kScale = 2;
// What averages of four pixels and mixes of four texels blur along each axis, texels: a deviation of which penumbrae have
// so much already.
const float kInherent = 0.5;
#else
const int kScale = 1;
const float kInherent = 0.0;
#endif

// A disc light's penumbra is a half circle, whose standard deviation is a quarter of its width. A Gaussian of this share of
// the width, cut off where the penumbra ends, has the same, and quartiles within 4 % of those.
const float kOfDisc = 0.25, kGaussian = 0.35;

// By how many texels a metre along a direction shifts the point.
vec2 texelsOfMetre(vec4 clip, vec3 directionV) {
  vec4 shift = view.clipFromView * vec4(directionV, 0.0);
  return 0.5 / float(kScale) * view.size.xy * (shift.xy - clip.xy / clip.w * shift.w) / clip.w;
}

// A circle on the surface is an ellipse in the picture. Its Gaussian is one along x and one along a skewed axis after
// another: Geusebroek and Smeulders, "Fast Anisotropic Gauss Filtering", IEEE Transactions on Image Processing 12(8), 2003.
// xy: the axis' step for a deviation of a metre; z: its larger extent along both axes of the picture; texels.
vec3 ellipseAxis(vec3 positionV, vec3 normalV, bool alongX) {
  vec4 clip = view.clipFromView * vec4(positionV, 1.0);
  vec3 along = normalize(abs(normalV.y) < 0.8 ? vec3(normalV.z, 0.0, -normalV.x) : vec3(0.0, -normalV.z, normalV.y));
  vec2 first = texelsOfMetre(clip, along), second = texelsOfMetre(clip, cross(normalV, along));
  float xx = first.x * first.x + second.x * second.x;
  float xy = first.x * first.y + second.x * second.y;
  float yy = max(first.y * first.y + second.y * second.y, 1e-12);
  float extent = sqrt(max(xx, yy));
  return alongX ? vec3(sqrt(max(xx - xy * xy / yy, 0.0)), 0.0, extent) : vec3(sqrt(yy) * vec2(xy / yy, 1.0), extent);
}

// exp2() of it times the square of a distance is the weight there. squared: of the penumbra's width.
float gaussianExponent(float squared) {
  return squared > 0.0 ? -0.7213475 / (kGaussian * kGaussian * squared) : 0.0;
}

// Taps stand for equal parts of a penumbra. width: m; ofMetre: texels of a metre along the axis; most: texels to either side.
float tapsApart(float width, float ofMetre, float most, int taps) {
  float radius = min(0.5 * width * ofMetre, most);
  return max(radius / (float(taps) + 0.5), 1.0);
}
