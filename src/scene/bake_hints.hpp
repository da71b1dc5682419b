// What a scene says about the baking of its light, for whoever bakes it. What it leaves open is the
// baker's choice.
#pragma once

#include <optional>

#include "core/math/math.hpp"

namespace lucerna::scene {

// Light of surfaces that emit, as system B bakes it (thesis 5.1.1, 5.1.3). With s the emissive
// colour, a piece dA of surface lights a white surface at distance d and angle beta to its normal
// by the brightness
//   s * intensity * dA / (attenuation * d^2) * cos(beta)
// where the direction to it is within `cut` of the emitting surface's normal, and not elsewhere.
// dA is in square metres, which is what one of the thesis' texels is at one texel a metre: there,
// the number belongs to a texel, so that it had to change with the density.
struct AreaLightRule {
  float cut = 0.5f * kPi;    // rad, half-angle, above 0 to pi/2
  float attenuation = 0.2f;  // 1/m^2, above 0
  float intensity = 10.f;    // 1/m^2; 0 and up
  bool operator==(const AreaLightRule&) const = default;
};

struct BakeHints {
  bool maps = true;        // of the lights that are always on
  bool patches = true;     // of the lights that switch (Light::group)
  bool areaLights = true;  // whether surfaces that emit light others
  // How they do; absent: by the radiance that they show.
  std::optional<AreaLightRule> area;
  // By how much a patch may be off its light: brightness of a white surface before exposure.
  std::optional<float> patchTolerance;
  std::optional<int> mapSize;  // texels along a side of a map, 16 to 16384
  bool operator==(const BakeHints&) const = default;
};

}  // namespace lucerna::scene
