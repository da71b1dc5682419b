// Whether anything can be in the way between a light and a block: if not, no ray is needed.
#pragma once

#include <array>
#include <vector>

#include "bake/samples.hpp"
#include "bake/world.hpp"
#include "scene/bvh.hpp"

namespace lucerna::bake {

// A convex region by the planes around it: inside is dot(xyz, p) + w >= 0.
class Shaft {
 public:
  void add(vec4 plane) { planes_[count_++] = plane; }
  bool mayMeet(const Aabb& box) const;
  bool mayMeet(const std::array<vec3, 3>& triangle) const;

 private:
  std::array<vec4, 8> planes_;
  std::size_t count_ = 0;
};

// Around all straight ways from a ball to a planar block (Haines and Wallace, "Shaft Culling for
// Efficient Ray-Traced Radiosity", 1994), above the block's plane.
Shaft shaftFrom(vec3 centreW, float radius, const Samples& block);
// The same from infinitely far away, as far as `length` m from the block: from directions within
// the angle of this sine around the direction.
Shaft shaftAlong(vec3 toLightW, float sine, float length, const Samples& block);

// Around the samples of a tile, where they are a planar block's: the thin box that they are in.
// Else the box.
Shaft slabAround(const Samples& samples, const Samples::Tile& tile, const Aabb& box);

// Immutable once made.
class Occluders {
 public:
  explicit Occluders(const World& world);
  // False only if no triangle is in the shaft; with `counts`, none of those that it says true of.
  bool anyIn(const Shaft& shaft) const;
  template <typename Counts>
  bool anyIn(const Shaft& shaft, const Counts& counts) const;

 private:
  std::array<vec3, 3> cornersOf(std::uint32_t triangle) const;

  const World& world_;
  scene::Bvh bvh_;  // over triangles
};

template <typename Counts>
bool Occluders::anyIn(const Shaft& shaft, const Counts& counts) const {
  const auto nodes = bvh_.nodes();
  if (nodes.empty()) return false;
  std::array<std::uint32_t, 128> stack;
  std::size_t depth = 0;
  stack[depth++] = 0;
  while (depth > 0) {
    const scene::Bvh::Node& node = nodes[stack[--depth]];
    if (!shaft.mayMeet(node.box)) continue;
    if (node.count == 0) {
      if (depth + 2 > stack.size()) return true;  // deeper than any tree that is built
      stack[depth++] = node.first + 1;
      stack[depth++] = node.first;
      continue;
    }
    for (std::uint32_t i = 0; i < node.count; ++i) {
      const std::uint32_t triangle = bvh_.items()[node.first + i];
      if (counts(triangle) && shaft.mayMeet(cornersOf(triangle))) return true;
    }
  }
  return false;
}

}  // namespace lucerna::bake
