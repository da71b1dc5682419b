// Axis-aligned boxes.
#pragma once

#include <limits>

#include "core/math/math.hpp"

namespace lucerna {

struct Aabb {
  vec3 min{std::numeric_limits<float>::infinity()};
  vec3 max{-std::numeric_limits<float>::infinity()};

  bool empty() const { return min.x > max.x || min.y > max.y || min.z > max.z; }
  vec3 center() const { return 0.5f * (min + max); }
  vec3 extent() const { return max - min; }  // full side lengths
  float diagonal() const { return empty() ? 0.f : glm::length(extent()); }
  void grow(vec3 point) {
    min = glm::min(min, point);
    max = glm::max(max, point);
  }
  void grow(const Aabb& other) {
    min = glm::min(min, other.min);
    max = glm::max(max, other.max);
  }
};

// The box of the transformed box (Arvo, Graphics Gems 1990). Empty stays empty.
inline Aabb transformed(const mat4& m, const Aabb& box) {
  if (box.empty()) return box;
  Aabb result{vec3(m[3]), vec3(m[3])};
  for (int axis = 0; axis < 3; ++axis) {
    const vec3 a = vec3(m[axis]) * box.min[axis];
    const vec3 b = vec3(m[axis]) * box.max[axis];
    result.min += glm::min(a, b);
    result.max += glm::max(a, b);
  }
  return result;
}

}  // namespace lucerna
