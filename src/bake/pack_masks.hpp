// Charts of any shape into square maps, to the texel: large ones first, each into the first map
// that has room, where its upper edge comes to lie lowest; in holes of others, too. (Bottom-left
// placement as in Baker, Coffman and Rivest, "Orthogonal Packings in Two Dimensions", 1980, of
// masks instead of rectangles.)
#pragma once

#include <span>
#include <vector>

#include "bake/coverage.hpp"
#include "bake/pack.hpp"
#include "bake/texel_mask.hpp"
#include "core/result.hpp"

namespace lucerna::bake {

// masks: each with a texel at least. Places say where their rectangles lie, which overlap; between
// texels of two masks there are at least settings.gap others, along x or along y. The same input
// gives the same output. Errors: as of pack().
Result<Packing> packMasks(std::span<const TexelMask> masks, const PackSettings& settings);

// A point p of chart i lies in its map at
// placedPoint(packing.places[i], masks[i].size(), p - least[i]).
struct PackedCharts {
  std::vector<vec2> least;  // coordinates
  std::vector<TexelMask> masks;
  Packing packing;
};

// charts: triangles of each, as coverageOf() takes them, but of any size. Errors: as of pack().
Result<PackedCharts> packCharts(std::span<const std::span<const FlatTriangle>> charts,
                                const PackSettings& settings);

// Share of the texels of all maps but the last that masks cover; of the only map, if there is one
// alone. 0 of nothing.
double occupancy(const Packing& packing, std::span<const TexelMask> masks, int side);

}  // namespace lucerna::bake
