// The texels that a patch lights.
#pragma once

#include "lightmap/texel_tiles.hpp"

namespace lucerna::lightmap {

// What the triangles say, without the patch's tiles. Every texel has its light from one triangle:
// the first that it lies in, else the first whose skirt (kSkirt) it lies in; of those that give
// it more than Patch::least.
TexelTiles lightOfTriangles(const Patch& patch);

TexelTiles decoded(const TileLight& light, std::size_t channels);

// All of it. The patch must be sound (patchFrom says so).
TileLight unpacked(const Patch& patch);

}  // namespace lucerna::lightmap
