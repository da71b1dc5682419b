// Irradiance of a polygon that emits the same radiance everywhere.
#pragma once

#include <span>

#include "core/math/math.hpp"

namespace lucerna::bake {

// Irradiance / radiance at a point of a surface, of a planar polygon that is seen in full; what
// lies behind the surface is cut off (Lambert, "Photometria", 1760: half the sum, over the sides,
// of the angle under which each is seen times the cosine of its plane's normal to the surface's).
// corners: at most 8 of a convex polygon, in turn, either way round; normal: unit.
float polygonIrradiance(std::span<const vec3> corners, vec3 position, vec3 normal);

}  // namespace lucerna::bake
