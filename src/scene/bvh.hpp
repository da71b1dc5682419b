// A bounding volume hierarchy over boxes, for culling.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/math/frustum.hpp"

namespace lucerna::scene {

class Bvh {
 public:
  // Binned surface-area build; deterministic. Items are the boxes' indices; empty boxes are left
  // out.
  void build(std::span<const Aabb> boxes);

  // boxes[i] is the new box of items[i]; an item named twice takes the last. The tree keeps its
  // shape and only the boxes above these items change: O(items * depth), at most O(all). Where that
  // would leave a poor tree (its surface-area cost has doubled since it was built), or where a box
  // becomes or was empty or unbounded, the tree is built anew. True if it was refitted.
  bool refit(std::span<const std::uint32_t> items, std::span<const Aabb> boxes);

  // Appends the items whose box intersects(frustum, box), exactly those, in no particular but
  // deterministic order.
  void query(const Frustum& frustum, std::vector<std::uint32_t>& items) const;

  // Appends the items whose box shares a point with this one, exactly those, in no particular but
  // deterministic order.
  void query(const Aabb& box, std::vector<std::uint32_t>& items) const;

  // The nearest place where a ray enters or leaves one of the boxes, as the distance in lengths of
  // `direction`; infinity if there is none.
  float firstSide(vec3 origin, vec3 direction) const;

  struct Node {
    Aabb box;
    std::uint32_t first =
        0;  // leaf: first in items(); inner: index of the left child, right is first + 1
    std::uint32_t count = 0;  // 0: inner node
  };
  std::span<const Node> nodes() const { return nodes_; }  // [0] is the root; empty if no items
  // In the order of the leaves. Boxes without finite bounds are in no leaf and stand at the end.
  std::span<const std::uint32_t> items() const { return items_; }

 private:
  struct Range {
    std::uint32_t first = 0, count = 0;
  };

  std::vector<Node> nodes_;
  std::vector<Range> ranges_;  // of each node: all items below it, in items_
  std::vector<std::uint32_t> items_;
  std::vector<Aabb> boxes_;  // in the order of items_
  std::uint32_t boundedCount_ = 0;

  // Adapts the box of a node to what is below it; false if it was right already.
  bool fit(std::uint32_t node);
  void rebuild(std::span<const std::uint32_t> items, std::span<const Aabb> boxes);
  void linkUpwards();

  std::vector<std::uint32_t> parents_;  // of each node; the root's is itself
  std::vector<std::uint32_t> leaves_;   // of each bounded slot of items_
  std::vector<std::uint32_t> slots_;    // of each item, its place in items_; kNoSlot: left out
  double area_ = 0, builtArea_ = 0;     // m^2, sum of the nodes' half areas: now, when built
};

}  // namespace lucerna::scene
