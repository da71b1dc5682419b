// Convex bodies as the common part of half-spaces.
#pragma once

#include <span>
#include <vector>

#include "core/math/bounds.hpp"

namespace lucerna {

// Six half-spaces as those of a Frustum: xyz unit and inward, a point p is inside where
// dot(xyz, p) + w >= 0.
std::vector<vec4> planesOf(const Aabb& box);

// The corners of a bounded body, in no particular but deterministic order; some may come twice, and
// they may lie outside it by rounding. Empty if nothing is inside. Every three planes are tried, so
// this is for some twenty planes at most.
std::vector<vec3> cornersOf(std::span<const vec4> planes);

}  // namespace lucerna
