// Seams closed: where two charts share an edge of a smooth surface, both show the same light there,
// so that no step is seen. Least squares over the texels that lookups along seams read: differences
// between the sides vanish while texels stay close to what was baked (Iwanicki, "Lighting
// Technology of The Last Of Us", SIGGRAPH 2013 Talks).
#pragma once

#include <cstdint>
#include <vector>

#include "bake/assemble.hpp"
#include "bake/plan.hpp"

namespace lucerna::bake {

// Steps across seams: of the brightness of a white surface at the scene's exposure, irradiance / pi
// * 2^EV within 0 and 1, the channel that differs most; everything that switches is on. Of halves,
// as they are stored, at points between those that were solved for; percentiles of the seams'
// length in texels.
struct SeamSteps {
  double median = 0., percentile99 = 0., largest = 0.;
};
// The same of maps as a copy in that encoding has them; groups as they are.
struct EncodedSteps {
  Encoding encoding;
  SeamSteps after;
};
struct SeamReport {
  std::uint64_t seams = 0;    // edges
  std::uint64_t texels = 0;   // unknowns
  std::uint64_t samples = 0;  // points where both sides ought to agree
  std::uint64_t parts = 0;    // solved each by itself
  std::uint64_t mostIterations = 0;
  SeamSteps before, after;
  std::vector<EncodedSteps> encoded;  // of copies that the settings ask for, but PNG
  double seconds = 0.;
};

// After dilate(): what that gave texels beside the charts is where they start. The maps and each
// group are solved alike, so that a group's light and the rest still add up. The same result for
// any number of threads. Ctrl-C (Progress::cancelled()) ends it early, with some seams open.
SeamReport closeSeams(const Plan& plan, BakedLight& baked);

}  // namespace lucerna::bake
