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

  // Appends the items whose box intersects(frustum, box), exactly those, in no particular but
  // deterministic order.
  void query(const Frustum& frustum, std::vector<std::uint32_t>& items) const;

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
};

}  // namespace lucerna::scene
