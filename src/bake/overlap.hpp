// Triangles that overlap where one goes on smoothly in the next: rays that test each triangle by
// itself, in single precision, then find no gap between them.
#pragma once

#include <span>
#include <vector>

#include "bake/world.hpp"

namespace lucerna::bake {

// Three corners of each of these triangles of the world, in the same order. An edge at which
// another one of them begins, bent by less than 30 degrees, is moved outwards in the triangle's
// plane by two rounding errors of its largest coordinate (for every 8 km, 1 to 2 mm). All others
// stay: what stuck out there would cast a shadow. Triangles that are not finite stay.
std::vector<vec3> overlapping(const World& world, std::span<const std::uint32_t> triangles);

}  // namespace lucerna::bake
