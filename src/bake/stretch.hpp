// How much a triangle is stretched when it is laid in a plane.
#pragma once

#include <array>

#include "core/math/math.hpp"

namespace lucerna::bake {

// Singular values of the affine map that takes the triangle to the plane: by how much lengths grow
// in the direction in which they grow most and least. least: below 0 where it is flipped.
struct Stretch {
  double most = 0, least = 0;
};

// in space: with an area.
Stretch stretchOf(const std::array<glm::dvec3, 3>& inSpace, const std::array<glm::dvec2, 3>& flat);

}  // namespace lucerna::bake
