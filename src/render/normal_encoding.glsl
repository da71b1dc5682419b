// Unit vectors in two numbers of [0, 1]: the octahedron folded flat.
// Meyer et al., "On Floating-Point Normal Vectors", EGSR 2010; Cigolle et al., "A Survey of Efficient
// Representations for Independent Unit Vectors", JCGT 3(2), 2014, section 3.
// The sphere-map encoding of system A is 0/0 at z = -1 and coarse near it; this one is even.

vec2 encodeNormal(vec3 n) {
  vec2 p = n.xy / (abs(n.x) + abs(n.y) + abs(n.z));
  vec2 signs = vec2(p.x >= 0.0 ? 1.0 : -1.0, p.y >= 0.0 ? 1.0 : -1.0);
  if (n.z < 0.0) p = (1.0 - abs(p.yx)) * signs;
  return p * 0.5 + 0.5;
}

vec3 decodeNormal(vec2 encoded) {
  vec2 p = encoded * 2.0 - 1.0;
  vec3 n = vec3(p, 1.0 - abs(p.x) - abs(p.y));
  float fold = max(-n.z, 0.0);
  n.xy += vec2(n.x >= 0.0 ? -fold : fold, n.y >= 0.0 ? -fold : fold);
  return normalize(n);
}
