// Light that goes straight through translucent surfaces: transmittance() of scene/material.hpp, and how shadow maps
// keep it.

vec3 lightThrough(float opacity, vec3 transmission) { return (1.0 - clamp(opacity, 0.0, 1.0)) * transmission; }

// A map adds up how often light is halved: the sum of whole numbers of steps does not depend on their order, as a
// product that is rounded at each factor would.
const float kMostHalvings = 16.0;     // beyond it is dark
const float kHalvingSteps = 65535.0;  // that a texel can tell apart

vec3 halvingsOf(vec3 transmittance) {
  vec3 share = -log2(max(transmittance, vec3(exp2(-kMostHalvings)))) / kMostHalvings;
  return round(share * kHalvingSteps) / kHalvingSteps;
}

vec3 afterHalvings(vec3 halvings) { return exp2(-kMostHalvings * halvings); }
