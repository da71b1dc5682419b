// Four moments of the depths around a point, and what they say of a depth: Peters and Klein, "Moment Shadow Mapping",
// I3D 2015. Depths are within [-1, 1], -1 nearest to the light.

// Of a shadow map's depth, which is reversed: linear in the distance along its axis, 0 half way. lampShare: of lamps, a
// depth d is at the share lampShare / (d + lampShare) of the farthest distance; not used for directional lights.
float momentDepth(bool directional, float lampShare, float mapDepth) {
  return directional ? 1.0 - 2.0 * mapDepth : (lampShare - mapDepth) / (lampShare + mapDepth);
}

vec4 momentsOf(float z) {
  float squared = z * z;
  return vec4(z, squared, z * squared, squared * squared);
}

// This share of the depths is taken to be spread evenly over the range: more than what rounding of 32-bit floats may do
// to moments, so that they stay those of some distribution.
const float kSpread = 2e-6;
const vec4 kEvenMoments = vec4(0.0, 1.0 / 3.0, 0.0, 1.0 / 5.0);

// The least share of depths before z that these moments allow, which is all there is where depths are at two places, z
// perhaps one of them. mean: of those before z; z where there are none.
//
// Of all distributions with the moments, the one that has an atom at z and two more has the least before z. In standard
// deviations from the mean, z is t; with the skewness s, the kurtosis k and D = k - s^2 - 1 the first orthonormal
// polynomials are 1, x and q(x) / sqrt(D), q(x) = x^2 - s x - 1. Their kernel K(t, x) = 1 + t x + q(t) q(x) / D is zero
// at the two other atoms, and t weighs 1 / K(t, t); the other two weigh what mass 1 and mean 0 leave.
struct DepthsBefore {
  float share;
  float mean;
};
DepthsBefore depthsBefore(vec4 moments, float z) {
  vec4 b = mix(moments, kEvenMoments, kSpread);
  float mean = b.x, variance = max(b.y - mean * mean, 1e-12);
  float third = b.z - mean * (3.0 * b.y - 2.0 * mean * mean);
  float fourth = b.w - mean * (4.0 * b.z - mean * (6.0 * b.y - 3.0 * mean * mean));
  float toDeviations = inversesqrt(variance);
  float t = (z - mean) * toDeviations, s = third * toDeviations / variance;
  float d = max(fourth / (variance * variance) - s * s - 1.0, 1e-12);
  float q = t * t - s * t - 1.0;
  float own = 1.0 / (1.0 + t * t + q * q / d);
  // K is zero where x^2 + (t d / q - s) x + d / q - 1 is; q near 0: one of them far away, where hardly anything is.
  float ratio = d / (abs(q) < 1e-9 ? 1e-9 : q);
  float middle = 0.5 * (s - t * ratio);
  float apart = sqrt(max(middle * middle - ratio + 1.0, 1e-12));
  float nearest = middle - apart, farthest = middle + apart;
  float ofNearest = clamp(((1.0 - own) * farthest + own * t) / (2.0 * apart), 0.0, 1.0);
  bool both = t > farthest, one = t > nearest;
  float share = both ? 1.0 - own : one ? ofNearest : 0.0;
  float before = both ? -own * t / max(1.0 - own, 1e-6) : one ? nearest : t;
  return DepthsBefore(share, mean + before / toDeviations);
}
