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

// Immutable once made.
class Occluders {
 public:
  explicit Occluders(const World& world);
  // False only if no triangle is in the shaft.
  bool anyIn(const Shaft& shaft) const;

 private:
  const World& world_;
  scene::Bvh bvh_;  // over triangles
};

}  // namespace lucerna::bake
