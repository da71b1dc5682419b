// Which texels of a lightmap a chart owns: all that its triangles touch. Conservative and exact, by
// integers: what a triangle spans of a row of texels, in texels touched from its left to its right
// end.
//
// A bilinear lookup at a point p reads the texels whose centres lie less than one texel from p
// along both axes. The texel around p is among them, and the others are its neighbours. So a lookup
// inside of a chart reads texels that the chart owns and their direct neighbours, which dilation
// fills. Two charts that have two texels between them share no such neighbour; at a map's edge the
// lookup is clamped to the texels there.
#pragma once

#include <array>
#include <span>

#include "bake/texel_mask.hpp"
#include "core/math/math.hpp"

namespace lucerna::bake {

using FlatTriangle = std::array<vec2, 3>;  // corners in texels, in either winding

// Texel (x, y) of the mask is the square from least + (x, y) to least + (x + 1, y + 1), and the
// mask is as small as it can be with that least corner.
struct Coverage {
  vec2 least{0.f};
  TexelMask mask;
};

// From the least coordinates of the triangles.
// Corners are rounded to 1/1024 of a texel from there, so that a side of 10.0001
// texels has 10. A texel counts if a triangle and it have an area in common; a triangle that has no
// area, or lost it by rounding, owns one texel a row at least, so that each chart has texels.
// triangles: at least one; finite, and no larger than kMostTexels.
Coverage coverageOf(std::span<const FlatTriangle> triangles);

// The same from another corner, none of whose coordinates is larger: parts of one grid.
Coverage coverageFrom(std::span<const FlatTriangle> triangles, vec2 least);

// Size of that mask alone, for charts of any size; at most INT_MAX / 2.
ivec2 coverageSize(std::span<const FlatTriangle> triangles);

inline constexpr int kMostTexels = 1 << 16;  // a side of a mask

}  // namespace lucerna::bake
