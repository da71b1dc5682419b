// Vertices at the same place are one.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/math/math.hpp"

namespace lucerna::bake {

// Of each position the lowest number of those at exactly its place. What is not finite counts as
// (0, 0, 0): no triangle that counts has it.
std::vector<std::uint32_t> weld(std::span<const vec3> positions);

}  // namespace lucerna::bake
