// A triangle of a patch over the texels of a map.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "lightmap/patch.hpp"

namespace lucerna::lightmap {

// How far beyond a chart's border its triangles still give light, texels: what partly lies on the
// chart, and what filters reach.
inline constexpr int kSkirt = 2;

using Point64 = glm::vec<2, std::int64_t>;

// In units that stay whole through all splits.
struct PatchTriangle {
  static constexpr std::int64_t kUnit = std::int64_t{kPatchUnit} << kMostSplits;  // of a texel

  std::array<Point64, 3> corners;
  unsigned borders = 0;  // as PatchRoot::borders
};

PatchTriangle triangleOf(const PatchRoot& root);
// Parts 0 to 2 have that corner in their place, part 3 lies between them.
PatchTriangle partOf(const PatchTriangle& triangle, int part);

// Texels whose middle lies in the triangle or on its edge, asked exactly (in whole numbers); with a
// skirt also those up to kSkirt beyond its borders. One row of them:
struct TexelRow {
  int begin = 0, end = 0;               // columns
  std::array<std::int64_t, 3> first{};  // weights of the corners at `begin`, times twice the area
};
class TriangleTexels {
 public:
  TriangleTexels(const PatchTriangle& triangle, bool skirt, int side);

  // Calls visit(x, y, weights of the corners): their sum is 1 and none is negative. Beyond a border
  // they are those of a point on it.
  template <typename Visit>
  void forEach(Visit visit) const {
    for (int y = begin_; y < end_; ++y) {
      const TexelRow row = rowAt(y);
      std::array<std::int64_t, 3> at = row.first;
      for (int x = row.begin; x < row.end; ++x) {
        visit(x, y, weightsOf(at));
        for (std::size_t i = 0; i < 3; ++i) at[i] += alongX_[i] * PatchTriangle::kUnit;
      }
    }
  }

 private:
  TexelRow rowAt(int y) const;
  static vec3 weightsOf(const std::array<std::int64_t, 3>& at) {
    std::array<double, 3> w{};
    for (std::size_t i = 0; i < 3; ++i)
      w[i] = static_cast<double>(std::max<std::int64_t>(at[i], 0));
    const double all = 1. / (w[0] + w[1] + w[2]);
    return {static_cast<float>(w[0] * all), static_cast<float>(w[1] * all),
            static_cast<float>(w[2] * all)};
  }

  int begin_ = 0, end_ = 0;  // rows
  int left_ = 0, right_ = 0;
  // Corner i weighs alongX_ x + alongY_ y + at0_; from -reach_ on the point belongs to it.
  std::array<std::int64_t, 3> alongX_{}, alongY_{}, at0_{}, reach_{};
};

}  // namespace lucerna::lightmap
