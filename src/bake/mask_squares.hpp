// A shape of texels as squares whose sides are powers of two. Squares may overlap; their union is
// the shape. Large ones first, so that a search for where the shape fits fails early.
#pragma once

#include <vector>

#include "bake/texel_mask.hpp"
#include "core/math/math.hpp"

namespace lucerna::bake {

inline constexpr int kSquareLevels = 7;  // sides of 1 to 64 texels

struct Square {
  ivec2 corner{0};  // the least texel
  int level = 0;    // its side is 2^level

  int side() const { return 1 << level; }
};

// By falling level; in a level those that follow each other lie apart.
std::vector<Square> squaresOf(const TexelMask& mask);

}  // namespace lucerna::bake
