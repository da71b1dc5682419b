// What translucent surfaces let through of lights, as LayeredTransmittance makes it (render/layered_shadows.hpp).
// Ten bits for each colour's square root, which keeps dark ones apart; above them, whether they are known.
const float kColorSteps = 1023.0;
const uint kColorMask = 1023u;

uint packedColor(vec3 color) {
  uvec3 steps = uvec3(kColorSteps * sqrt(color) + 0.5);
  return 1u << 30 | steps.b << 20 | steps.g << 10 | steps.r;
}

vec3 unpackedColor(uint bits) {
  vec3 root = vec3(bits & kColorMask, bits >> 10 & kColorMask, bits >> 20 & kColorMask) / kColorSteps;
  return root * root;
}

bool isKnown(uint bits) { return bits >> 30 != 0u; }
