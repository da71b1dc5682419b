// Which triangles of a scene are one smooth surface, so that none of them is in the way of another
// where they meet.
#pragma once

#include <cstdint>
#include <vector>

#include "bake/plan.hpp"

namespace lucerna::bake {

// Of a chart that is a mesh's own set of coordinates, what is connected over edges that bend by
// less than 40 degrees is a part: such a chart may hold a floor and the box that stands in it. Any
// other chart is one part.
struct SurfaceParts {
  std::vector<std::uint32_t> of;      // of each triangle of the world: its part, or kNone
  std::vector<std::uint32_t> places;  // of each vertex of the world: the same for the same place;
                                      // empty if no chart is a mesh's own
};

SurfaceParts surfaceParts(const Plan& plan);

}  // namespace lucerna::bake
