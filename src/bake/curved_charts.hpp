// Charts of any mesh: flat parts as they are, and smoothly bent ones unfolded with little stretch.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "bake/chart_growth.hpp"
#include "core/math/math.hpp"

namespace lucerna::bake {

struct CurvedSettings {
  float mostStretch = 2.f;   // that lengths may grow or shrink by, in any direction
  float leastFilled = 0.4f;  // of a chart's rectangle, else it is cut in two; flat parts are not
  GrowthSettings growth{};
};

struct CurvedChart {
  std::vector<std::uint32_t> triangles;  // in rising order
  // Where the corners of each lie, from (0, 0) to `size`, the smallest rectangle around all. In the
  // positions' units: a curved chart's area is that of its triangles, a flat one's is true to
  // scale. Counter-clockwise, as the mesh has them.
  std::vector<std::array<vec2, 3>> corners;
  vec2 size{0.f};
  vec3 normal{0.f};  // unit, of flat ones, which are one affine map; 0 of others
};

struct CurvedCharts {
  std::vector<CurvedChart> charts;        // by their first triangles
  std::vector<std::uint32_t> degenerate;  // triangles that have no area, or are not finite
};

// indices: three a triangle, of positions. Each triangle that is not degenerate is in one chart, in
// which none is flipped or stretched above `mostStretch`, and none lies on another (by more than
// 1/50000 of the chart's longer side). Vertices at exactly the same place are one. A chart does not
// depend on triangles that are not connected with it, and not on the number of threads.
CurvedCharts curvedCharts(std::span<const vec3> positions, std::span<const std::uint32_t> indices,
                          const CurvedSettings& settings = {});

}  // namespace lucerna::bake
