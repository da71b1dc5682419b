// Points of the unit square that spread evenly: the (0, 2)-sequence of Sobol's first two
// dimensions, shuffled and scrambled by a hash for every pixel and purpose (Burley, "Practical
// Hash-based Owen Scrambling", JCGT 9(4), 2020).
#pragma once

#include <cstdint>

#include "core/math/math.hpp"

namespace lucerna::trace {

// Mixes a value into a hash; every bit of the result depends on all of both.
std::uint32_t mixed(std::uint32_t hash, std::uint32_t value);

// The index-th point of the sequence that belongs to `sequence`. Any power of two many, from a
// multiple of it on, are stratified in all elementary boxes.
vec2 lowDiscrepancyPoint(std::uint32_t index, std::uint32_t sequence);

}  // namespace lucerna::trace
