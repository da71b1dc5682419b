// Connected triangles of one plane, laid flat without stretch: most of what is built consists of
// such charts.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/math/math.hpp"

namespace lucerna::bake {

struct PlanarSettings {
  float offPlane = 1e-3f;    // that vertices may lie off a chart's plane, in the positions' units
  float cosNormal = 0.999f;  // between a triangle's normal and that of its chart, at least
};

// A point p of the chart lies at (dot(p - origin, alongU), dot(p - origin, alongV)), from (0, 0) to
// `size`: the smallest rectangle around it.
struct PlanarChart {
  std::vector<std::uint32_t> triangles;        // in rising order
  vec3 normal{0.f};                            // unit, of the side that is counter-clockwise
  vec3 origin{0.f}, alongU{0.f}, alongV{0.f};  // alongU, alongV: unit, at right angles
  vec2 size{0.f};                              // in the positions' units
};

struct PlanarCharts {
  std::vector<PlanarChart> charts;        // largest triangle first
  std::vector<std::uint32_t> degenerate;  // triangles that have no area, or are not finite
};

// indices: three a triangle, of positions. Vertices at exactly the same place are one, whatever
// else tells them apart. Triangles that lie on each other never share a chart.
PlanarCharts planarCharts(std::span<const vec3> positions, std::span<const std::uint32_t> indices,
                          const PlanarSettings& settings = {});

}  // namespace lucerna::bake
