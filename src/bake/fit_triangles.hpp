// The thesis' patches (system B, section 5.1.4): triangles of the maps between whose corners light
// may be interpolated, split in four until it may.
//
// Beyond the thesis: a corner's light is that which fits the texels best, not that of one texel;
// and where splitting further takes more bytes than the texels themselves, these are left over.
#pragma once

#include <span>
#include <vector>

#include "lightmap/layout.hpp"
#include "lightmap/texel_tiles.hpp"

namespace lucerna::bake {

// Every triangle of the layout that has an area, on its grid; borders where no other shares the
// edge.
std::vector<lightmap::PatchRoot> rootsOf(const lightmap::Layout& layout);

struct FitSettings {
  vec3 tolerance{0.f};                      // of each channel
  int side = 0;                             // texels of each map
  std::span<const std::vector<bool>> used;  // as PatchMaker has it
};

// Triangles that give `light` within the tolerance, as far as they are worth it.
lightmap::TriangleLight fitTriangles(std::span<const lightmap::PatchRoot> roots,
                                     lightmap::TexelTiles& light, const FitSettings& settings);

}  // namespace lucerna::bake
