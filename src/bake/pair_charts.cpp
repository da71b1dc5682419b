#include "bake/pair_charts.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "bake/triangle.hpp"

namespace lucerna::bake {
namespace {

struct RightTriangle {
  std::uint32_t number = 0;
  std::size_t rightAngle = 0,
              longEnd = 0;  // which of its corners: the angle, and the end of the longer leg
  float longLeg = 0, shortLeg = 0;
};

RightTriangle madeRight(std::uint32_t number, const std::array<vec3, 3>& p) {
  RightTriangle t{.number = number};
  float longest = -1;
  for (std::size_t k = 0; k < 3; ++k)  // the side across from it
    if (const float side = glm::distance(p[(k + 1) % 3], p[(k + 2) % 3]); side > longest) {
      longest = side;
      t.rightAngle = k;
    }
  const std::size_t next = (t.rightAngle + 1) % 3, last = (t.rightAngle + 2) % 3;
  const float toNext = glm::distance(p[t.rightAngle], p[next]),
              toLast = glm::distance(p[t.rightAngle], p[last]);
  t.longEnd = toNext >= toLast ? next : last;
  std::tie(t.shortLeg, t.longLeg) = std::minmax(toNext, toLast);
  return t;
}

std::array<vec2, 3> cornersOf(const RightTriangle& t, bool second) {
  std::array<vec2, 3> corners;
  corners[t.rightAngle] = vec2(0.f);
  corners[t.longEnd] = vec2(1.f, 0.f);
  corners[3 - t.rightAngle - t.longEnd] = vec2(0.f, 1.f);
  if (second)
    for (vec2& corner : corners) corner = 1.f - corner;
  return corners;
}

}  // namespace

PairCharts pairCharts(std::span<const vec3> positions, std::span<const std::uint32_t> indices,
                      float tolerance) {
  PairCharts result;
  std::vector<RightTriangle> triangles;
  for (std::uint32_t i = 0; i < indices.size() / 3; ++i) {
    const std::array<vec3, 3> p{positions[indices[3 * i]], positions[indices[3 * i + 1]],
                                positions[indices[3 * i + 2]]};
    if (shapeOf(p).area > 0.f)
      triangles.push_back(madeRight(i, p));
    else
      result.degenerate.push_back(i);
  }
  std::ranges::stable_sort(triangles, [](const RightTriangle& a, const RightTriangle& b) {
    return std::tuple(a.longLeg, a.shortLeg) > std::tuple(b.longLeg, b.shortLeg);
  });
  std::vector<bool> taken(triangles.size(), false);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    if (taken[i]) continue;
    const RightTriangle& a = triangles[i];
    PairChart chart;
    chart.first = a.number;
    chart.size = {a.longLeg, a.shortLeg};
    chart.firstCorners = cornersOf(a, false);
    // Of those whose longer leg is about as long, the first whose shorter one is, too.
    for (std::size_t j = i + 1; j < triangles.size(); ++j) {
      const RightTriangle& b = triangles[j];
      if (b.longLeg < a.longLeg * (1 - tolerance)) break;
      if (taken[j] ||
          std::abs(a.shortLeg - b.shortLeg) > tolerance * std::max(a.shortLeg, b.shortLeg))
        continue;
      taken[j] = true;
      chart.second = b.number;
      chart.size.y = std::max(a.shortLeg, b.shortLeg);
      chart.secondCorners = cornersOf(b, true);
      break;
    }
    result.charts.push_back(chart);
  }
  return result;
}

}  // namespace lucerna::bake
