#include "bake/pair_charts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "bake/triangle_soup.hpp"
#include "core/random.hpp"

namespace lucerna::bake {
namespace {

double crossOf(vec2 a, vec2 b) {
  return static_cast<double>(a.x) * b.y - static_cast<double>(a.y) * b.x;
}

// A triangle fills its half of the rectangle, and its legs are as long as it says.
void expectHalf(const TriangleSoup& soup, const PairChart& chart, std::uint32_t triangle,
                const std::array<vec2, 3>& corners, float tolerance) {
  EXPECT_NEAR(std::abs(crossOf(corners[1] - corners[0], corners[2] - corners[0])), 1, 1e-6);
  for (std::size_t k = 0; k < 3; ++k) {
    const vec2 side = (corners[(k + 1) % 3] - corners[k]) * chart.size;
    const bool leg = side.x == 0.f || side.y == 0.f;
    const float length = glm::distance(soup.positions[soup.indices[3 * triangle + k]],
                                       soup.positions[soup.indices[3 * triangle + (k + 1) % 3]]);
    if (leg) {
      EXPECT_NEAR(glm::length(side), length, tolerance * glm::length(side) + 1e-5f);
    }
  }
}

TEST(PairCharts, JoinTheHalvesOfRectangles) {
  TriangleSoup soup;
  soup.add({0, 0, 0}, {3, 0, 0}, {3, 2, 0});
  soup.add({5, 5, 5}, {5, 5, 6}, {5, 9, 5});  // legs of 1 and 4
  soup.add({0, 0, 0}, {3, 2, 0}, {0, 2, 0});
  const PairCharts found = pairCharts(soup.positions, soup.indices);
  ASSERT_EQ(found.charts.size(), 2u);
  EXPECT_EQ(found.charts[0].first, 1u);
  EXPECT_EQ(found.charts[0].second, PairChart::kAlone);
  EXPECT_EQ(found.charts[0].size, vec2(4, 1));
  EXPECT_EQ(found.charts[1].first, 0u);
  EXPECT_EQ(found.charts[1].second, 2u);
  EXPECT_EQ(found.charts[1].size, vec2(3, 2));
  EXPECT_EQ(found.charts[1].firstCorners[1], vec2(0, 0)) << "the right angle";
  EXPECT_EQ(found.charts[1].firstCorners[0], vec2(1, 0));
  EXPECT_EQ(found.charts[1].secondCorners[2], vec2(1, 1));
}

TEST(PairCharts, HoldEachTriangleOnce) {
  Random random(3);
  TriangleSoup soup;
  const auto place = [&] {
    return 4.f * vec3(random.uniform(), random.uniform(), random.uniform());
  };
  for (int i = 0; i < 400; ++i) soup.add(place(), place(), place());
  soup.add(vec3(0), vec3(1), vec3(2));
  constexpr float kTolerance = 0.05f;
  const PairCharts found = pairCharts(soup.positions, soup.indices, kTolerance);
  EXPECT_EQ(found.degenerate, std::vector<std::uint32_t>{400});
  std::multiset<std::uint32_t> seen;
  std::size_t pairs = 0;
  for (const PairChart& chart : found.charts) {
    seen.insert(chart.first);
    expectHalf(soup, chart, chart.first, chart.firstCorners, kTolerance);
    if (chart.second == PairChart::kAlone) continue;
    ++pairs;
    seen.insert(chart.second);
    expectHalf(soup, chart, chart.second, chart.secondCorners, kTolerance);
  }
  ASSERT_EQ(seen.size(), 400u);
  std::uint32_t expected = 0;
  for (const std::uint32_t triangle : seen) EXPECT_EQ(triangle, expected++);
  EXPECT_GT(pairs, 20u);
}

}  // namespace
}  // namespace lucerna::bake
