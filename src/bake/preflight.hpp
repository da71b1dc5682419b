// What is odd about a scene that is to be baked, before anything is.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bake/plan.hpp"

namespace lucerna::bake {

struct Preflight {
  std::uint64_t notFinite = 0, degenerate = 0;  // triangles: a corner is no number; no area
  std::uint64_t huge = 0;                 // triangles: a corner is too far off (kFarthestCorner)
  std::uint64_t duplicate = 0;            // triangles with the corners of an earlier one
  std::uint64_t shrunk = 0;               // charts that are larger than a map
  std::uint64_t unlit = 0;                // objects that take no light
  std::uint64_t bending = 0, moving = 0;  // objects; those that do both bend
  std::uint64_t lights = 0;               // that are baked
  std::vector<std::string> buried;        // names of lights inside of solids (bake/hidden.hpp)

  // One sentence for each that is not as it should be, but for what Plan::warnings says.
  std::vector<std::string> sentences() const;
};

Preflight inspect(const Plan& plan);

}  // namespace lucerna::bake
