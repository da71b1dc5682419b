// The charts of system B (section 4.2), the baseline: each triangle is made right-angled over its
// two shorter sides, and two whose legs are as long share a rectangle. It stretches what has no
// right angle, and each triangle has seams all around.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/math/math.hpp"

namespace lucerna::bake {

struct PairChart {
  static constexpr std::uint32_t kAlone = 0xffffffffu;
  std::uint32_t first = 0, second = kAlone;  // triangles
  vec2 size{0.f};  // the longer and the shorter leg, in the positions' units

  // Where the corners of the first or second triangle lie, in the order in which the mesh has them,
  // as shares of the rectangle. The right angle of the first is at (0, 0), that of the second at
  // (1, 1).
  std::array<vec2, 3> firstCorners{}, secondCorners{};
};

struct PairCharts {
  std::vector<PairChart> charts;          // by falling legs
  std::vector<std::uint32_t> degenerate;  // triangles that have no area, or are not finite
};

// indices: three a triangle, of positions. tolerance: by which share of the longer one legs of a
// pair may differ; the rectangle has the longer ones.
PairCharts pairCharts(std::span<const vec3> positions, std::span<const std::uint32_t> indices,
                      float tolerance = 0.01f);

}  // namespace lucerna::bake
