// Curved pieces of surface laid out in the plane: conformally (Lévy, Petitjean, Ray and Maillot,
// "Least Squares Conformal Maps", 2002, in the form of Mullen, Tong, Alliez and Desbrun, "Spectral
// Conformal Parameterization", 2008, section 2), then as rigidly as possible (Liu, Zhang, Xu,
// Gotsman and Gortler, "A Local/Global Approach to Mesh Parameterization", 2008), so that texels
// are as large everywhere.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/math/math.hpp"

namespace lucerna::bake {

struct Piece {
  std::vector<glm::dvec3> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;  // of points; joined, at least one
};

// Scales the plane so that the triangles have the area they have in space.
void scaleToArea(const Piece& piece, std::vector<glm::dvec2>& at);

// start: where the points lie to begin with, without flipped triangles. Nothing is promised of the
// result but that it is as likely better: look for flips, stretch and overlap. Always the same
// bits.
std::vector<glm::dvec2> unfold(const Piece& piece, std::vector<glm::dvec2> start);

}  // namespace lucerna::bake
