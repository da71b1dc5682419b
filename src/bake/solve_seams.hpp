// One part of a system of seams, solved.
#pragma once

#include <span>

#include "bake/seam_system.hpp"

namespace lucerna::bake {

// values: of the part's texels, not negative, in brightness; three channels at once. Moves them to
// where
//   sum over samples of share * difference^2 + sum over texels of stiffness * change^2
// is least, and none is negative. By conjugate gradients (Hestenes and Stiefel, 1952), scaled by
// the diagonal. Linear in the values but where a texel would become negative. Values that agree
// stay as they are. Returns the iterations.
std::uint64_t solve(const SeamSystem& system, const SeamPart& part, std::span<glm::dvec3> values);

}  // namespace lucerna::bake
