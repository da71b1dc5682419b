// Axis-aligned boxes.
#pragma once

#include <algorithm>
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

// The part of a ray that lies inside the box, as distances from 0 on in lengths of `direction`
// (Kay and Kajiya, SIGGRAPH 1986). Empty if first > last.
struct RaySpan {
  float first = 0.f, last = std::numeric_limits<float>::infinity();
};
inline RaySpan spanInside(const Aabb& box, vec3 origin, vec3 direction) {
  RaySpan span;
  for (int axis = 0; axis < 3; ++axis) {
    const float a = (box.min[axis] - origin[axis]) / direction[axis];
    const float b = (box.max[axis] - origin[axis]) / direction[axis];
    // In this order a NaN, of a ray inside a side's plane, changes nothing.
    span.first = std::max(span.first, std::min(a, b));
    span.last = std::min(span.last, std::max(a, b));
  }
  return span;
}

}  // namespace lucerna
