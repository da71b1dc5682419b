// Which lights may reach which tiles of a picture, as TileLights finds them and
// render/tile_lights.glsl reads them.
#pragma once

#include <cstdint>

#include "gpu/device.hpp"

namespace lucerna::render {

struct TileLights {
  static constexpr const char* kPortName = "TileLights";
  std::uint32_t tiles = 0;  // in all
  gpu::Buffer block;        // TileLightBlock; none: who made it did not know
};

inline constexpr int kLightTile = 16;  // px, side of a tile; as in render/tile_lights.glsl

}  // namespace lucerna::render
