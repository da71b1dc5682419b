// Coverages, against every texel tested by itself.
#include "bake/coverage.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "core/random.hpp"

namespace lucerna::bake {
namespace {

// Whether a triangle and the texel have an area in common: no line along one of their sides has the
// one on its left and the other on its right. Exact for what has few bits.
bool share(const FlatTriangle& triangle, int x, int y) {
  std::vector<glm::dvec2> across{{1, 0}, {0, 1}};
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::dvec2 side = glm::dvec2(triangle[(i + 1) % 3]) - glm::dvec2(triangle[i]);
    across.emplace_back(-side.y, side.x);
  }
  return std::ranges::none_of(across, [&](glm::dvec2 axis) {
    double low = INFINITY, high = -INFINITY, texelLow = INFINITY, texelHigh = -INFINITY;
    for (const vec2 corner : triangle)
      low = std::min(low, glm::dot(axis, glm::dvec2(corner))),
      high = std::max(high, glm::dot(axis, glm::dvec2(corner)));
    for (const ivec2 corner : {ivec2(x, y), ivec2(x + 1, y), ivec2(x, y + 1), ivec2(x + 1, y + 1)})
      texelLow = std::min(texelLow, glm::dot(axis, glm::dvec2(corner))),
      texelHigh = std::max(texelHigh, glm::dot(axis, glm::dvec2(corner)));
    return high <= texelLow || low >= texelHigh;
  });
}

double areaOf(const FlatTriangle& t) {
  const vec2 a = t[1] - t[0], b = t[2] - t[0];
  return std::abs(double{a.x} * b.y - double{a.y} * b.x) / 2;
}

// Corners on a grid of 1/steps of a texel; coarse ones often lie on the borders of texels.
FlatTriangle someTriangle(Random& random, float size, float steps) {
  FlatTriangle triangle;
  for (vec2& corner : triangle)
    corner = glm::floor(vec2(random.uniform(0.f, size), random.uniform(0.f, size)) * steps) / steps;
  return triangle;
}

TEST(Coverage, HasWhatTrianglesTouchAndNoMore) {
  Random random(1);
  int compared = 0;
  for (const float steps : {1.f, 2.f, 16.f, 1024.f})
    for (const float size : {2.f, 9.f, 90.f})
      for (int i = 0; i < 60; ++i) {
        std::vector<FlatTriangle> triangles(1 + static_cast<std::size_t>(i) % 3);
        for (FlatTriangle& triangle : triangles) triangle = someTriangle(random, size, steps);
        if (std::ranges::any_of(triangles, [](const auto& t) { return areaOf(t) == 0; })) continue;
        const Coverage coverage = coverageOf(triangles);
        const ivec2 extent = coverage.mask.size();
        EXPECT_EQ(extent, coverageSize(triangles));
        for (FlatTriangle& triangle : triangles)
          for (vec2& corner : triangle) corner -= coverage.least;
        for (int y = 0; y < extent.y; ++y)
          for (int x = 0; x < extent.x; ++x)
            ASSERT_EQ(coverage.mask.at(x, y),
                      std::ranges::any_of(triangles, [&](const auto& t) { return share(t, x, y); }))
                << x << ", " << y << " of " << extent.x << " x " << extent.y;
        ++compared;
      }
  EXPECT_GT(compared, 500);
}

TEST(Coverage, OfARectangleIsARectangle) {
  for (const float noise : {-4e-4f, 0.f, 4e-4f}) {
    const vec2 least(-7.3f, 1000.25f), most = least + vec2(10.f, 70.f) + noise;
    const std::vector<FlatTriangle> triangles{{least, {most.x, least.y}, most},
                                              {least, most, {least.x, most.y}}};
    const Coverage coverage = coverageOf(triangles);
    EXPECT_EQ(coverage.mask.size(), ivec2(10, 70));
    EXPECT_EQ(coverage.mask.count(), 700);
    EXPECT_EQ(coverage.least, least);
  }
}

TEST(Coverage, RoundsWhatNearlyEndsOnABorder) {
  for (const float noise : {-4e-4f, 4e-4f}) {
    const float x = 5.f + noise;
    const std::vector<FlatTriangle> triangles{{vec2(0), vec2(x, 0), vec2(x, 10)},
                                              {vec2(x, 20), vec2(10, 20), vec2(x, 30)}};
    const Coverage coverage = coverageOf(triangles);
    for (int y = 0; y < 10; ++y) EXPECT_FALSE(coverage.mask.at(5, y));
    for (int y = 20; y < 30; ++y) EXPECT_FALSE(coverage.mask.at(4, y));
    EXPECT_TRUE(coverage.mask.at(4, 5));
    EXPECT_TRUE(coverage.mask.at(5, 25));
  }
}

TEST(Coverage, GivesWhatHasNoAreaTexelsAllTheSame) {
  const vec2 p(3.f, 4.f);
  const std::vector<FlatTriangle> point{{p, p, p}}, upright{{p, p + vec2(0, 5), p}},
      slanted{{p, p + vec2(4), p + vec2(2)}},
      sliver{{p, p + vec2(100.f, 0), p + vec2(50.f, 1e-5f)}};
  EXPECT_EQ(coverageOf(point).mask.count(), 1);
  EXPECT_EQ(coverageOf(upright).mask.size(), ivec2(1, 5));
  EXPECT_EQ(coverageOf(upright).mask.count(), 5);
  EXPECT_EQ(coverageOf(slanted).mask.size(), ivec2(4));
  EXPECT_GE(coverageOf(slanted).mask.count(), 4);
  EXPECT_EQ(coverageOf(sliver).mask.size(), ivec2(100, 1));
  EXPECT_EQ(coverageOf(sliver).mask.count(), 100);
}

// What bilinear filtering reads at points of a chart is its own, or next to that.
TEST(Coverage, IsWhatLookupsRead) {
  Random random(2);
  for (int i = 0; i < 200; ++i) {
    const FlatTriangle triangle = someTriangle(random, 20.f, 1024.f);
    const Coverage coverage = coverageOf(std::span(&triangle, 1));
    const auto owns = [&](ivec2 texel) {
      return glm::all(glm::greaterThanEqual(texel, ivec2(0))) &&
             glm::all(glm::lessThan(texel, coverage.mask.size())) &&
             coverage.mask.at(texel.x, texel.y);
    };
    for (int k = 0; k < 100; ++k) {
      const float a = random.uniform(0.f, 1.f), b = random.uniform(0.f, 1.f - a);
      const vec2 p = triangle[0] + a * (triangle[1] - triangle[0]) +
                     b * (triangle[2] - triangle[0]) - coverage.least;
      for (const vec2 centre : {vec2(-0.5f), vec2(0.5f, -0.5f), vec2(-0.5f, 0.5f), vec2(0.5f)}) {
        const ivec2 read = glm::floor(p + centre);
        bool near = false;
        for (int y = -1; y <= 1; ++y)
          for (int x = -1; x <= 1; ++x) near |= owns(read + ivec2(x, y));
        EXPECT_TRUE(near) << p.x << ", " << p.y;
      }
    }
  }
}

TEST(Coverage, SaysHowLargeAChartWouldBe) {
  const FlatTriangle triangle{vec2(0.f), vec2(1e6f, 0.f), vec2(0.f, 1e30f)};
  EXPECT_EQ(coverageSize(std::span(&triangle, 1)).x, 1000000);
  EXPECT_EQ(coverageSize(std::span(&triangle, 1)).y, std::numeric_limits<int>::max() / 2);
}

}  // namespace
}  // namespace lucerna::bake
