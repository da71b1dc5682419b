// Points along seams where both sides ought to show the same light.
#pragma once

#include <span>
#include <vector>

#include "bake/find_seams.hpp"
#include "bake/shadow_tracer.hpp"

namespace lucerna::bake {

struct SeamPoint {
  std::uint32_t seam = 0;
  float along = 0.f;  // 0 at the seam's first end, 1 at its second
  float share = 0.f;  // texels of the seam that it stands for
};

// Some a texel; `extra` more of each seam lie between those without. Points where something stands
// between the two sides are left out, as a wall that divides a floor: light jumps there.
std::vector<SeamPoint> seamPoints(std::span<const Seam> seams, int extra,
                                  const ShadowTracer& tracer);

}  // namespace lucerna::bake
