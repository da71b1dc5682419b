// What a triangle is like, and whether it is one.
#pragma once

#include <array>

#include "core/math/math.hpp"

namespace lucerna::bake {

bool isFinite(vec3 p);

// normal: unit, of the counter-clockwise side. Both are 0 where corners are not finite, or the
// triangle's height is lost in the rounding of its corners.
struct TriangleShape {
  vec3 normal{0.f};
  float area = 0.f;
};
TriangleShape shapeOf(const std::array<vec3, 3>& corners);

}  // namespace lucerna::bake
