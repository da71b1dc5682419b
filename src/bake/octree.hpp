// Triangles in an octree, and its leaves along a segment.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/math/bounds.hpp"

namespace lucerna::bake {

// Immutable once made.
class Octree {
 public:
  using Corners = std::array<vec3, 3>;

  // A cell of more than leafSize triangles is cut in eight, breadth first, unless
  // - it is 2^-kMaxDepth as wide as the root,
  // - that makes no fewer tests, as a ray through a cell crosses a quarter of its parts on the
  //   average, by the surfaces (MacDonald and Booth, "Heuristics for Ray Tracing Using Space
  //   Subdivision", 1990), and one part keeps more than two thirds of the triangles, or
  // - the leaves would name more than kMostNames triangles for each there is.
  // Triangles with corners that are not finite, or farther than 1e18 m off, are left out.
  Octree(std::span<const Corners> triangles, std::size_t leafSize);

  static constexpr int kMaxDepth = 14;
  static constexpr std::size_t kMostNames = 8;

  // Calls leaf(span of triangles) for leaves that hold triangles, from `from` to `to`, until one
  // returns true; returns whether one did. Each triangle that comes within rounding of the segment
  // is in one of them, if not in several.
  template <typename Leaf>
  bool visit(vec3 from, vec3 to, Leaf&& leaf) const;

  std::size_t nodeCount() const { return nodes_.size(); }
  std::size_t nameCount() const { return names_.size(); }  // of triangles, in all leaves

 private:
  static constexpr std::uint32_t kInner = 0xffffffffu;
  struct Node {
    vec3 middle{0.f};
    std::uint32_t first = 0;  // of names_, or of its eight parts: bit k is the upper half of axis k
    std::uint32_t count = 0;  // of names_; kInner: it has parts
  };
  // A stretch of the segment in a node, in shares of its length.
  struct Stretch {
    std::uint32_t node;
    float enter, leave;
  };
  struct Builder;
  bool clip(vec3& from, vec3& to) const;

  Aabb box_;  // of the root, wider than its triangles
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> names_;
};

// Front to back: a node's part is known by the middle planes that the segment has crossed, and
// those it has yet to cross, in order, lead to the next ones. All planes are compared by the same
// rounded shares of the segment, so stretches follow each other without a gap.
template <typename Leaf>
bool Octree::visit(vec3 from, vec3 to, Leaf&& leaf) const {
  if (nodes_.empty() || !clip(from, to)) return false;
  vec3 perShare;
  std::uint32_t falling = 0;  // axes along which the segment runs downwards
  for (int axis = 0; axis < 3; ++axis) {
    const float along = to[axis] - from[axis];
    if (along < 0.f) falling |= 1u << axis;
    // As good as never, where it runs along the planes.
    perShare[axis] = 1.f / (std::abs(along) > 1e-30f ? along : 1e-30f);
  }
  std::array<Stretch, 3 * kMaxDepth + 4> stack;
  std::size_t depth = 0;
  stack[depth++] = {0, 0.f, 1.f};
  while (depth > 0) {
    const auto [index, enter, leave] = stack[--depth];
    const Node& node = nodes_[index];
    if (node.count != kInner) {
      if (node.count > 0 && leaf(std::span(names_).subspan(node.first, node.count))) return true;
      continue;
    }
    const vec3 crossing = (node.middle - from) * perShare;
    std::uint32_t crossed = 0;
    for (int axis = 0; axis < 3; ++axis)
      if (enter >= crossing[axis]) crossed |= 1u << axis;
    std::array<Stretch, 4> parts;
    std::size_t count = 0;
    for (float at = enter;;) {
      float next = leave;
      std::uint32_t plane = 0;
      for (int axis = 0; axis < 3; ++axis)
        if (!(crossed & (1u << axis)) && crossing[axis] < next) {
          next = crossing[axis];
          plane = 1u << axis;
        }
      parts[count++] = {node.first + (crossed ^ falling), at, next};
      if (plane == 0) break;
      crossed |= plane;
      at = next;
    }
    while (count > 0) stack[depth++] = parts[--count];
  }
  return false;
}

}  // namespace lucerna::bake
