#include "bake/chart_overlap.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace lucerna::bake {
namespace {

using Corners = std::array<glm::dvec2, 3>;

struct Box {
  glm::dvec2 low{0}, high{0};
};

Box boxOf(const Corners& t) {
  return {glm::min(glm::min(t[0], t[1]), t[2]), glm::max(glm::max(t[0], t[1]), t[2])};
}

// How far b reaches over the side of `a` that it reaches over least.
double depthInside(const Corners& a, const Corners& b) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 3; ++k) {
    const glm::dvec2 side = a[(k + 1) % 3] - a[k];
    const glm::dvec2 inward = glm::dvec2(-side.y, side.x) / glm::length(side);
    double depth = 0;
    for (const glm::dvec2 corner : b) depth = std::max(depth, glm::dot(corner - a[k], inward));
    least = std::min(least, depth);
  }
  return least;
}

// Convex shapes are apart if and only if a side of one has the other beyond it.
bool overlap(const Corners& a, const Corners& b, double tolerance) {
  return depthInside(a, b) > tolerance && depthInside(b, a) > tolerance;
}

// Square cells, about as many as triangles, that list which boxes they touch.
class Grid {
 public:
  explicit Grid(const std::vector<Box>& boxes) {
    Box all = boxes[0];
    for (const Box& box : boxes) all = {glm::min(all.low, box.low), glm::max(all.high, box.high)};
    low_ = all.low;
    const glm::dvec2 size = all.high - all.low;
    cell_ = std::max(std::sqrt(size.x * size.y / static_cast<double>(boxes.size())),
                     std::max(size.x, size.y) / kMostCells);
    cells_ = cellOf(all.high) + 1;
    starts_.assign(static_cast<std::size_t>(cells_.x) * cells_.y + 1, 0);
    for (const Box& box : boxes)
      forCells(box, [&](ivec2, std::size_t cell) { ++starts_[cell + 1]; });
    for (std::size_t i = 1; i < starts_.size(); ++i) starts_[i] += starts_[i - 1];
    lists_.resize(starts_.back());
    std::vector<std::size_t> ends(starts_.begin(), starts_.end() - 1);
    for (std::uint32_t i = 0; i < boxes.size(); ++i)
      forCells(boxes[i], [&](ivec2, std::size_t cell) { lists_[ends[cell]++] = i; });
  }

  ivec2 cellOf(glm::dvec2 p) const { return ivec2((p - low_) / cell_); }
  template <typename Body>  // body(cell, its number)
  void forCells(const Box& box, const Body& body) const {
    const ivec2 first = cellOf(box.low), last = cellOf(box.high);
    for (int y = first.y; y <= last.y; ++y)
      for (int x = first.x; x <= last.x; ++x)
        body(ivec2(x, y), static_cast<std::size_t>(y) * cells_.x + x);
  }
  std::span<const std::uint32_t> list(std::size_t cell) const {
    return std::span(lists_).subspan(starts_[cell], starts_[cell + 1] - starts_[cell]);
  }

 private:
  static constexpr double kMostCells = 4096;  // along a side
  glm::dvec2 low_{0};
  double cell_ = 1;
  ivec2 cells_{1};
  std::vector<std::size_t> starts_;
  std::vector<std::uint32_t> lists_;
};

}  // namespace

bool overlap(std::span<const std::array<glm::dvec2, 3>> triangles, double tolerance) {
  if (triangles.size() < 2) return false;
  std::vector<Box> boxes;
  for (const Corners& triangle : triangles) boxes.push_back(boxOf(triangle));
  const Grid grid(boxes);
  bool found = false;
  for (std::uint32_t i = 0; i < triangles.size() && !found; ++i)
    grid.forCells(boxes[i], [&](ivec2 cell, std::size_t number) {
      for (const std::uint32_t j : grid.list(number)) {
        if (found || j >= i) return;
        const glm::dvec2 low = glm::max(boxes[i].low, boxes[j].low),
                         high = glm::min(boxes[i].high, boxes[j].high);
        if (glm::any(glm::greaterThanEqual(low, high)) || grid.cellOf(low) != cell)
          continue;  // another cell has them, too
        found = overlap(triangles[i], triangles[j], tolerance);
      }
    });
  return found;
}

}  // namespace lucerna::bake
