// Small copies of shadow maps that keep what is nearest to the light, as NearestBlockers makes them
// and render/nearest_blockers.glsl reads them.
#pragma once

#include "gpu/device.hpp"

namespace lucerna::render {

// R32Float arrays with a layer for each of the maps' (render/shadow_maps.hpp). A texel of level l
// is the greatest, that is nearest, reversed depth of a block of (8 << l)^2 texels; the last of a
// row or column holds what is left over, too.
struct NearestBlockers {
  static constexpr const char* kPortName = "NearestBlockers";
  static constexpr int kBlock = 8;  // texels, side of a block of level 0; as in the shaders
  gpu::Texture directional, local;
  gpu::Texture directionalPanes, localPanes;  // of translucent surfaces; none where no map sees any
};

}  // namespace lucerna::render
