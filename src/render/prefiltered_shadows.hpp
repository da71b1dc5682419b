// Shadow maps prefiltered: moments of the depths around each place, as PrefilteredShadows makes
// them and render/prefiltered_shadows.glsl reads them.
#pragma once

#include <vector>

#include "gpu/device.hpp"
#include "render/shadow_maps.hpp"

namespace lucerna::render {

struct PrefilteredShadows {
  static constexpr const char* kPortName = "PrefilteredShadows";
  // Rgba32Float arrays with the layers of ShadowMaps::directional and local, maps at their places:
  // mean of z, z^2, z^3 and z^4 (render/moments.glsl), blurred. None without maps.
  gpu::Texture directional, local;
  // Whether they have levels, each blurred and halved anew from the one before, for penumbrae that
  // are as wide as the light's size makes them; a map has those with kCoarsestSide texels and more.
  static constexpr int kCoarsestSide = 8;
  bool levels = false;
  int texels = 1;  // of a shadow map, along each side of a texel of these
  // Standard deviation of the places whose depths a lookup takes together, along each axis, texels
  // of a shadow map.
  float deviation = 0.f;
  // What the textures show, and what it was made from. No place overlaps another.
  struct Made {
    ShadowMaps::Drawn drawn;
    int kernel = 0;
    bool operator==(const Made&) const = default;
  };
  std::vector<Made> made;
};

// Beyond its edge a map goes on as it is there.
void bindPrefilteredShadows(gpu::Commands& commands, const PrefilteredShadows& shadows);

}  // namespace lucerna::render
