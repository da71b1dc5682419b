// The rectangle of least area around points of a plane.
#pragma once

#include <vector>

#include "core/math/math.hpp"

namespace lucerna::bake {

// A point p lies in it at (dot(p - corner, along), dot(p - corner, across())), from (0, 0) to
// `size`.
struct Rectangle {
  glm::dvec2 corner{0}, along{1, 0}, size{0};  // along: unit
  glm::dvec2 across() const { return {-along.y, along.x}; }
};

// points: not all on one line.
Rectangle smallestRectangle(std::vector<glm::dvec2> points);

}  // namespace lucerna::bake
