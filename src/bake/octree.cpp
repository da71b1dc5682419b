#include "bake/octree.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <iterator>

#include "core/check.hpp"

namespace lucerna::bake {
namespace {

using glm::dvec3;

constexpr float kFarthest = 1e18f;  // m

bool isNear(const Octree::Corners& corners) {
  return std::ranges::all_of(corners, [](vec3 p) {
    return std::abs(p.x) <= kFarthest && std::abs(p.y) <= kFarthest && std::abs(p.z) <= kFarthest;
  });
}

// Whether the projections of triangle and box on an axis are apart; half: of the box, around 0.
bool apart(dvec3 axis, const std::array<dvec3, 3>& p, dvec3 half) {
  const double a = glm::dot(axis, p[0]), b = glm::dot(axis, p[1]), c = glm::dot(axis, p[2]);
  const double reach = glm::dot(glm::abs(axis), half);
  return std::min({a, b, c}) > reach || std::max({a, b, c}) < -reach;
}

// Of a triangle whose box meets the box, by Akenine-Moeller, "Fast 3D Triangle-Box Overlap
// Testing", 2001: the triangle's plane, and the axes across an edge of each.
bool overlap(const Octree::Corners& corners, const Aabb& box) {
  const dvec3 middle = 0.5 * (dvec3(box.min) + dvec3(box.max));
  const dvec3 half = dvec3(box.max) - middle;
  const std::array p{dvec3(corners[0]) - middle, dvec3(corners[1]) - middle,
                     dvec3(corners[2]) - middle};
  const std::array edges{p[1] - p[0], p[2] - p[1], p[0] - p[2]};
  if (apart(glm::cross(edges[0], edges[1]), p, half)) return false;
  return std::ranges::none_of(edges, [&](dvec3 e) {
    return apart({0., -e.z, e.y}, p, half) || apart({e.z, 0., -e.x}, p, half) ||
           apart({-e.y, e.x, 0.}, p, half);
  });
}

// A bit for each part of a cell that the triangle's box meets.
std::uint32_t partsMet(const Octree::Corners& corners, vec3 middle, float margin) {
  constexpr std::array<std::uint32_t, 3> kUpper{0b10101010, 0b11001100, 0b11110000};
  const vec3 low = glm::min(glm::min(corners[0], corners[1]), corners[2]);
  const vec3 high = glm::max(glm::max(corners[0], corners[1]), corners[2]);
  std::uint32_t parts = 0xff;
  for (int axis = 0; axis < 3; ++axis) {
    if (low[axis] > middle[axis] + margin) parts &= kUpper[axis];
    if (high[axis] < middle[axis] - margin) parts &= ~kUpper[axis];
  }
  return parts;
}

Aabb grown(Aabb box, float margin) {
  box.min -= margin;
  box.max += margin;
  return box;
}

Aabb part(const Aabb& box, std::uint32_t octant) {
  const vec3 middle = box.center();
  Aabb result = box;
  for (int axis = 0; axis < 3; ++axis)
    (octant & (1u << axis) ? result.min : result.max)[axis] = middle[axis];
  return result;
}

}  // namespace

struct Octree::Builder {
  struct Cell {
    std::uint32_t node = 0;
    int depth = 0;
    Aabb box;
    std::vector<std::uint32_t> triangles;
  };

  // To the parts of a cell that a triangle of the cell comes near.
  void hand(std::uint32_t triangle, vec3 middle, std::array<Cell, 8>& parts) const {
    const std::uint32_t met = partsMet(triangles[triangle], middle, margin);
    for (std::uint32_t k = 0; k < 8; ++k)
      if (met == 1u << k ||
          ((met & (1u << k)) && overlap(triangles[triangle], grown(parts[k].box, margin))))
        parts[k].triangles.push_back(triangle);
  }

  // Cuts the cell and queues its parts, or returns false.
  bool cut(const Cell& cell) {
    const std::size_t all = cell.triangles.size();
    if (all <= leafSize || all >= tooMany || cell.depth == kMaxDepth) return false;
    std::array<Cell, 8> parts;
    std::size_t sum = 0, most = 0;
    const auto first = static_cast<std::uint32_t>(tree.nodes_.size());
    for (std::uint32_t k = 0; k < 8; ++k)
      parts[k] = {
          .node = first + k, .depth = cell.depth + 1, .box = part(cell.box, k), .triangles = {}};
    for (const std::uint32_t triangle : cell.triangles) hand(triangle, cell.box.center(), parts);
    for (const Cell& made : parts) {
      sum += made.triangles.size();
      most = std::max(most, made.triangles.size());
    }
    if (sum >= 4 * all && 3 * most > 2 * all) return false;
    if (names + sum - all > mostNames) {
      tooMany = all;
      return false;
    }
    names += sum - all;
    tree.nodes_[cell.node] = {.middle = cell.box.center(), .first = first, .count = kInner};
    tree.nodes_.resize(tree.nodes_.size() + 8);
    std::ranges::move(parts, std::back_inserter(cells));
    return true;
  }

  void build(Cell root) {
    names = root.triangles.size();
    mostNames = kMostNames * names;
    tree.nodes_.resize(1);
    cells.push_back(std::move(root));
    while (!cells.empty()) {
      const Cell cell = std::move(cells.front());
      cells.pop_front();
      if (cut(cell)) continue;
      tree.nodes_[cell.node].first = static_cast<std::uint32_t>(tree.names_.size());
      tree.nodes_[cell.node].count = static_cast<std::uint32_t>(cell.triangles.size());
      tree.names_.insert(tree.names_.end(), cell.triangles.begin(), cell.triangles.end());
    }
  }

  Octree& tree;
  std::span<const Corners> triangles;
  std::size_t leafSize;
  float margin;  // m, around cells: more than the rounding of a segment's stretches
  std::size_t names = 0, mostNames = 0;
  std::size_t tooMany = ~std::size_t{0};  // so many triangles of a cell made too many names
  std::deque<Cell> cells{};               // to be cut or made leaves
};

Octree::Octree(std::span<const Corners> triangles, std::size_t leafSize) {
  CHECK(triangles.size() < kInner / kMostNames, "{} triangles", triangles.size());
  Builder::Cell root;
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    if (!isNear(triangles[i])) continue;
    for (const vec3 p : triangles[i]) box_.grow(p);
    root.triangles.push_back(i);
  }
  if (root.triangles.empty()) return;
  // A cube, so that cells are.
  const vec3 size = glm::max(glm::abs(box_.min), glm::abs(box_.max));
  const float farthest = std::max({size.x, size.y, size.z, 1e-6f});
  const float margin = 0x1p-20f * (farthest + box_.diagonal());
  const vec3 extent = box_.extent();
  const float side = std::max({extent.x, extent.y, extent.z}) + 4.f * margin;
  const vec3 middle = box_.center();
  box_ = {middle - 0.5f * side, middle + 0.5f * side};
  root.box = box_;
  Builder{.tree = *this, .triangles = triangles, .leafSize = leafSize, .margin = margin}.build(
      std::move(root));
}

// To the part in the root's box, so that roundings are of its size; false if there is none.
bool Octree::clip(vec3& from, vec3& to) const {
  const dvec3 start(from), along = dvec3(to) - start;
  double enter = 0., leave = 1.;
  for (int axis = 0; axis < 3; ++axis) {
    if (along[axis] == 0.) {
      if (from[axis] < box_.min[axis] || from[axis] > box_.max[axis]) return false;
      continue;
    }
    const double a = (box_.min[axis] - start[axis]) / along[axis];
    const double b = (box_.max[axis] - start[axis]) / along[axis];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  if (enter > leave) return false;
  if (leave < 1.) to = vec3(start + leave * along);
  if (enter > 0.) from = vec3(start + enter * along);
  return true;
}

}  // namespace lucerna::bake
