// Which texels of a map its charts lie on, found from the layout alone: for looking at a bake, and
// for checking one.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "lightmap/layout.hpp"

namespace lucerna::lightmap {

// A triangle counts where it reaches farther into a texel than this share of it.
inline constexpr float kClearOfBorder = 1.f / 512.f;

// Calls visit(x, y) for the texels that the triangle touches: by separating axes (Gottschalk, Lin
// and Manocha, "OBBTree", 1996) between it and the texel's square.
template <typename Visit>
void forEachTexel(const std::array<vec2, 3>& corners, int side, Visit visit) {
  const vec2 low = glm::min(corners[0], glm::min(corners[1], corners[2]));
  const vec2 high = glm::max(corners[0], glm::max(corners[1], corners[2]));
  constexpr float kHalf = 0.5f - kClearOfBorder;
  struct Edge {
    vec2 across;              // the edge turned by a right angle
    float least = 0.f, most;  // of the triangle along it, and of half a square
  };
  std::array<Edge, 3> edges;
  for (std::size_t i = 0; i < 3; ++i) {
    const vec2 edge = corners[(i + 1) % 3] - corners[i];
    const vec2 across(-edge.y, edge.x);
    const float a = glm::dot(across, corners[i]), b = glm::dot(across, corners[(i + 2) % 3]);
    const float reach = kHalf * (std::abs(across.x) + std::abs(across.y));
    edges[i] = {across, std::min(a, b) - reach, std::max(a, b) + reach};
  }
  const ivec2 first = glm::max(ivec2(glm::floor(low - 0.5f + kHalf)), ivec2(0));
  const ivec2 last = glm::min(ivec2(glm::floor(high)), ivec2(side - 1));
  for (int y = first.y; y <= last.y; ++y)
    for (int x = first.x; x <= last.x; ++x) {
      const vec2 middle = vec2(x, y) + 0.5f;
      bool touches = true;
      for (int axis = 0; axis < 2; ++axis)
        touches = touches && middle[axis] - kHalf < high[axis] && middle[axis] + kHalf > low[axis];
      for (const Edge& edge : edges) {
        const float at = glm::dot(edge.across, middle);
        touches = touches && at > edge.least && at < edge.most;
      }
      if (touches) visit(x, y);
    }
}

struct ChartTexels {
  static constexpr std::uint32_t kNothing = 0xffffffffu;
  int side = 0;
  std::vector<std::uint32_t> charts;    // of each texel, row by row: the first that touches it
  std::vector<std::uint32_t> overlaps;  // places of texels that more than one chart touches, rising

  std::uint32_t at(int x, int y) const {
    const bool inside = x >= 0 && y >= 0 && x < side && y < side;
    return inside ? charts[static_cast<std::size_t>(y) * side + x] : kNothing;
  }
  // Whether filters that read a chart's texels may read this one, which lies on none.
  bool isBeside(int x, int y) const;
  // Whether it lies on a chart, and a neighbour in its row or column not on the same.
  bool isBorder(int x, int y) const;
};

ChartTexels chartTexels(const Layout& layout, int map);

// Texels a metre of each triangle's place, as Layout::objects; 0 where it has none, or has no area
// in the scene. The layout fits the scene.
std::vector<std::vector<float>> densities(const Layout& layout, const scene::Scene& scene);

}  // namespace lucerna::lightmap
