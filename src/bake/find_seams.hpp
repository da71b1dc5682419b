// Seams: edges where a smooth surface goes on in another place of the maps.
#pragma once

#include <array>
#include <vector>

#include "bake/plan.hpp"

namespace lucerna::bake {

// Both sides' first points are one point of the world, and so are their second ones.
struct SeamSide {
  int map = 0;
  std::array<vec2, 2> ends{};  // texels of the map, as the layout has them
  vec3 offW{0.f};  // m; from the seam to some of a texel away from it and as far off the surface
};
struct Seam {
  std::array<vec3, 2> endsW{};  // m
  std::array<SeamSide, 2> sides{};

  float length() const;  // texels, of the longer side
};

// Two triangles that take light, of one object or two, whose edges have ends at exactly the same
// places and which lie on different sides of it, with their fronts to the same side. Their normals
// at both ends agree.
// Where a corner of one triangle lies within an edge of another (a T-junction), no seam is found.
// In the order of the world's edges, the same for the same plan.
std::vector<Seam> findSeams(const Plan& plan);

}  // namespace lucerna::bake
