// One part of a system of seams, solved.
#pragma once

#include <span>

#include "bake/seam_system.hpp"

namespace lucerna::bake {

// values: of one channel of the part's texels, not negative, in brightness. Moves them to where
//   sum over samples of share * difference^2 + sum over texels of stiffness * change^2
// is least of all values that are not negative: by conjugate gradients, with steps along the
// gradient where values meet 0 (MPRGP: Dostal and Schoeberl, "Minimizing Quadratic Functions
// Subject to Bound Constraints", 2005). Linear in the values but where some meet 0. Values that
// agree stay as they are. Returns the iterations.
std::uint64_t solve(const SeamSystem& system, const SeamPart& part, std::span<double> values);

}  // namespace lucerna::bake
