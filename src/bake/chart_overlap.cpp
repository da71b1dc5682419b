#include "bake/chart_overlap.hpp"

#include <algorithm>
#include <cmath>
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

// Whether b reaches over one of the sides of `a` by no more than `tolerance`.
bool beside(const Corners& a, const Corners& b, double tolerance) {
  for (std::size_t k = 0; k < 3; ++k) {
    const glm::dvec2 side = a[(k + 1) % 3] - a[k];
    double depth = 0;  // times the side's length
    for (const glm::dvec2 corner : b)
      depth = std::max(depth, side.x * (corner.y - a[k].y) - side.y * (corner.x - a[k].x));
    if (depth * depth <= tolerance * tolerance * glm::dot(side, side)) return true;
  }
  return false;
}

// Convex shapes are apart if and only if one has a side that the other is beside.
bool overlap(const Corners& a, const Corners& b, double tolerance) {
  return !beside(a, b, tolerance) && !beside(b, a, tolerance);
}

// Square cells that list which boxes they touch: about as many as boxes, or fewer so that the lists
// stay short in all.
class Grid {
 public:
  explicit Grid(const std::vector<Box>& boxes) {
    Box all = boxes[0];
    for (const Box& box : boxes) all = {glm::min(all.low, box.low), glm::max(all.high, box.high)};
    low_ = all.low;
    const glm::dvec2 size = all.high - all.low;
    cell_ = std::max(std::sqrt(size.x * size.y / static_cast<double>(boxes.size())),
                     std::max(size.x, size.y) / kMostCells);
    while (entries(boxes) > kMostEntries * static_cast<double>(boxes.size())) cell_ *= 2;
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
  static constexpr double kMostEntries = 64;  // a box

  double entries(const std::vector<Box>& boxes) const {
    double sum = 0;
    for (const Box& box : boxes) {
      const glm::dvec2 touched(cellOf(box.high) - cellOf(box.low) + 1);
      sum += touched.x * touched.y;
    }
    return sum;
  }

  glm::dvec2 low_{0};
  double cell_ = 1;
  ivec2 cells_{1};
  std::vector<std::size_t> starts_;
  std::vector<std::uint32_t> lists_;
};

}  // namespace

std::optional<std::array<std::uint32_t, 2>> findOverlap(
    std::span<const std::array<glm::dvec2, 3>> triangles, double tolerance) {
  if (triangles.size() < 2) return {};
  std::vector<Box> boxes;
  for (const Corners& triangle : triangles) boxes.push_back(boxOf(triangle));
  const Grid grid(boxes);
  std::optional<std::array<std::uint32_t, 2>> found;
  for (std::uint32_t i = 0; i < triangles.size() && !found; ++i)
    grid.forCells(boxes[i], [&](ivec2 cell, std::size_t number) {
      for (const std::uint32_t j : grid.list(number)) {
        if (found || j >= i) return;
        const glm::dvec2 low = glm::max(boxes[i].low, boxes[j].low),
                         high = glm::min(boxes[i].high, boxes[j].high);
        if (glm::any(glm::greaterThanEqual(low, high)) || grid.cellOf(low) != cell)
          continue;  // another cell has them, too
        if (overlap(triangles[i], triangles[j], tolerance)) found = {j, i};
      }
    });
  return found;
}

}  // namespace lucerna::bake
