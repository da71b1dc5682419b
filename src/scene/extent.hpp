// How far away things may lie.
#pragma once

#include <cmath>

#include "core/math/bounds.hpp"

namespace lucerna::scene {

// m along each axis; the squares of lengths stay finite.
inline constexpr float kFarthest = 1e15f;

// False of what is not a number, too.
inline bool withinReach(vec3 p) {
  return std::abs(p.x) <= kFarthest && std::abs(p.y) <= kFarthest && std::abs(p.z) <= kFarthest;
}
inline bool withinReach(const Aabb& box) {
  return withinReach(box.min) && withinReach(box.max);
}

}  // namespace lucerna::scene
