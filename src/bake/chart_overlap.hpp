// Whether triangles of a plane lie on each other.
#pragma once

#include <array>
#include <span>

#include "core/math/math.hpp"

namespace lucerna::bake {

// Whether two of them share more than their edges: neither can be moved by `tolerance` or less to
// lie beside the other. So cracks closed to rounding, and what is thinner than `tolerance`, do not
// count. Triangles: counter-clockwise. Fast where they are about as large and do not overlap.
bool overlap(std::span<const std::array<glm::dvec2, 3>> triangles, double tolerance);

}  // namespace lucerna::bake
