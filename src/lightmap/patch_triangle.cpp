#include "lightmap/patch_triangle.hpp"

#include <cmath>

namespace lucerna::lightmap {
namespace {

constexpr std::int64_t kUnit = PatchTriangle::kUnit;

std::int64_t cross(Point64 a, Point64 b) {
  return a.x * b.y - a.y * b.x;
}

std::int64_t floorDivided(std::int64_t a, std::int64_t b) {
  const std::int64_t quotient = a / b;
  return quotient - (a % b != 0 && (a < 0) != (b < 0) ? 1 : 0);
}

std::int64_t middle(int texel) {
  return texel * kUnit + kUnit / 2;
}

}  // namespace

PatchTriangle triangleOf(const PatchRoot& root) {
  PatchTriangle triangle{.corners = {}, .borders = root.borders};
  for (std::size_t i = 0; i < 3; ++i)
    triangle.corners[i] = Point64(root.corners[i]) * (kUnit / kPatchUnit);
  return triangle;
}

PatchTriangle partOf(const PatchTriangle& triangle, int part) {
  const auto& [a, b, c] = triangle.corners;
  const Point64 ab = (a + b) / std::int64_t{2}, bc = (b + c) / std::int64_t{2},
                ca = (c + a) / std::int64_t{2};
  // A part at corner i shares with the whole the two edges that meet there, not that opposite.
  switch (part) {
    case 0:
      return {{a, ab, ca}, triangle.borders & 6u};
    case 1:
      return {{ab, b, bc}, triangle.borders & 5u};
    case 2:
      return {{ca, bc, c}, triangle.borders & 3u};
    default:
      return {{bc, ca, ab}, 0};
  }
}

TriangleTexels::TriangleTexels(const PatchTriangle& triangle, bool skirt, int side) {
  const auto& p = triangle.corners;
  const std::int64_t area = cross(p[1] - p[0], p[2] - p[0]);
  if (area == 0) return;  // no rows
  const std::int64_t turn = area < 0 ? -1 : 1;
  for (std::size_t i = 0; i < 3; ++i) {
    const Point64 from = p[(i + 1) % 3], edge = p[(i + 2) % 3] - from;
    alongX_[i] = -edge.y * turn;
    alongY_[i] = edge.x * turn;
    at0_[i] = -cross(edge, from) * turn;
    if (skirt && (triangle.borders >> i & 1) != 0)
      reach_[i] = static_cast<std::int64_t>(
          std::hypot(static_cast<double>(edge.x), static_cast<double>(edge.y)) * kSkirt * kUnit);
  }
  const Point64 low = glm::min(glm::min(p[0], p[1]), p[2]),
                high = glm::max(glm::max(p[0], p[1]), p[2]);
  const int around = skirt ? kSkirt : 0;
  const auto first = [&](std::int64_t v) {
    return std::max(static_cast<int>(v / kUnit) - around, 0);
  };
  const auto end = [&](std::int64_t v) {
    return std::min(static_cast<int>(v / kUnit) + 1 + around, side);
  };
  begin_ = first(low.y), end_ = end(high.y);
  left_ = first(low.x), right_ = end(high.x);
}

TexelRow TriangleTexels::rowAt(int y) const {
  std::int64_t begin = left_, end = right_;
  std::array<std::int64_t, 3> start{};  // weights at column 0
  for (std::size_t i = 0; i < 3; ++i) {
    start[i] = alongX_[i] * middle(0) + alongY_[i] * middle(y) + at0_[i];
    // start + x step >= -reach
    const std::int64_t step = alongX_[i] * kUnit, most = start[i] + reach_[i];
    if (step > 0)
      begin = std::max(begin, -floorDivided(most, step));
    else if (step < 0)
      end = std::min(end, floorDivided(most, -step) + 1);
    else if (most < 0)
      end = begin;
  }
  begin = std::min<std::int64_t>(begin, right_);
  TexelRow row{.begin = static_cast<int>(begin), .end = static_cast<int>(std::max(begin, end))};
  for (std::size_t i = 0; i < 3; ++i) row.first[i] = start[i] + begin * alongX_[i] * kUnit;
  return row;
}

}  // namespace lucerna::lightmap
