// Which triangles of a plane lie on each other.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "core/math/math.hpp"

namespace lucerna::bake {

// Two that share more than their edges, the first found, always the same: neither can be moved by
// `tolerance` or less to lie beside the other. So cracks closed to rounding, and what is thinner
// than `tolerance`, do not count. Triangles: counter-clockwise. Fast where boxes around them
// seldom overlap.
std::optional<std::array<std::uint32_t, 2>> findOverlap(
    std::span<const std::array<glm::dvec2, 3>> triangles, double tolerance);

}  // namespace lucerna::bake
