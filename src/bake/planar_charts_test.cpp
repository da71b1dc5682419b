// Charts of meshes whose planes are known.
#include "bake/planar_charts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "bake/triangle_soup.hpp"

namespace lucerna::bake {
namespace {

struct Mesh : TriangleSoup {
  void addQuad(vec3 corner, vec3 u, vec3 v) {
    add(corner, corner + u, corner + u + v);
    add(corner, corner + u + v, corner + v);
  }
  void addBox(vec3 low, vec3 size) {
    const vec3 x(size.x, 0, 0), y(0, size.y, 0), z(0, 0, size.z), high = low + size;
    addQuad(low, y, x), addQuad(low, z, y), addQuad(low, x, z);
    addQuad(high, -x, -y), addQuad(high, -y, -z), addQuad(high, -z, -x);
  }
  void turn(const glm::mat3& by) {
    for (vec3& p : positions) p = by * p;
  }
  PlanarCharts charts(const PlanarSettings& settings = {}) const {
    return planarCharts(positions, indices, settings);
  }
};

glm::mat3 someTurn() {
  return glm::mat3(glm::mat3_cast(glm::normalize(glm::quat(0.3f, 0.5f, -0.2f, 0.8f))));
}

// Each triangle is in one chart or degenerate; each chart is as large as it says, and lies flat.
void expectWhole(const Mesh& mesh, const PlanarCharts& found) {
  std::multiset<std::uint32_t> seen(found.degenerate.begin(), found.degenerate.end());
  for (const PlanarChart& chart : found.charts) {
    EXPECT_TRUE(std::ranges::is_sorted(chart.triangles));
    EXPECT_NEAR(glm::length(chart.alongU), 1, 1e-5);
    EXPECT_NEAR(glm::dot(chart.alongU, chart.alongV), 0, 1e-5);
    EXPECT_NEAR(glm::dot(glm::cross(chart.alongU, chart.alongV), chart.normal), 1, 1e-5);
    vec2 low(1e30f), high(-1e30f);
    for (const std::uint32_t triangle : chart.triangles) {
      seen.insert(triangle);
      for (std::uint32_t k = 0; k < 3; ++k) {
        const vec3 p = mesh.positions[mesh.indices[3 * triangle + k]] - chart.origin;
        EXPECT_NEAR(glm::dot(p, chart.normal), 0, 2e-3);
        const vec2 at(glm::dot(p, chart.alongU), glm::dot(p, chart.alongV));
        low = glm::min(low, at), high = glm::max(high, at);
      }
    }
    for (int c = 0; c < 2; ++c) {
      EXPECT_NEAR(low[c], 0, 1e-4);
      EXPECT_NEAR(high[c], chart.size[c], 1e-4);
    }
  }
  ASSERT_EQ(seen.size(), mesh.indices.size() / 3);
  std::uint32_t expected = 0;
  for (const std::uint32_t triangle : seen) EXPECT_EQ(triangle, expected++);
}

TEST(PlanarCharts, OfABoxAreItsSixSides) {
  for (const bool turned : {false, true}) {
    Mesh mesh;
    mesh.addBox({-1, 2, 3}, {1, 2, 3});
    if (turned) mesh.turn(someTurn());
    const PlanarCharts found = mesh.charts();
    expectWhole(mesh, found);
    EXPECT_TRUE(found.degenerate.empty());
    ASSERT_EQ(found.charts.size(), 6u);
    std::multiset<int> areas;
    for (const PlanarChart& chart : found.charts) {
      EXPECT_EQ(chart.triangles.size(), 2u);
      areas.insert(static_cast<int>(std::lround(100 * chart.size.x * chart.size.y)));
    }
    EXPECT_EQ(areas, (std::multiset<int>{200, 200, 300, 300, 600, 600}));
  }
}

TEST(PlanarCharts, JoinWhatOnlyTouchesByItsCorners) {
  Mesh mesh;  // three squares in an L, of vertices of their own
  mesh.addQuad({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  mesh.addQuad({1, 0, 0}, {1, 0, 0}, {0, 1, 0});
  mesh.addQuad({0, 1, 0}, {1, 0, 0}, {0, 1, 0});
  mesh.addQuad({5, 0, 0}, {1, 0, 0}, {0, 1, 0});  // of the same plane, elsewhere
  mesh.turn(someTurn());
  const PlanarCharts found = mesh.charts();
  expectWhole(mesh, found);
  ASSERT_EQ(found.charts.size(), 2u);
  EXPECT_EQ(found.charts[0].triangles.size() + found.charts[1].triangles.size(), 8u);
  const PlanarChart& large = found.charts[found.charts[0].triangles.size() == 6 ? 0 : 1];
  EXPECT_EQ(large.triangles.size(), 6u);
  EXPECT_NEAR(large.size.x * large.size.y, 4, 1e-3);
}

TEST(PlanarCharts, EndWherePlanesDo) {
  for (const float degrees : {0.1f, 1.f, 3.f, 90.f, 179.f}) {
    SCOPED_TRACE(degrees);
    Mesh mesh;
    const float angle = degrees * kPi / 180;
    mesh.addQuad({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    mesh.addQuad({1, 0, 0}, {std::cos(angle), 0, std::sin(angle)}, {0, 1, 0});
    const PlanarCharts found = mesh.charts({.offPlane = 0.01f});
    expectWhole(mesh, mesh.charts());
    EXPECT_EQ(found.charts.size(), degrees < 0.5f ? 1u : 2u);
  }
}

// A copy of a triangle, and both sides of a sheet.
TEST(PlanarCharts, KeepApartWhatLiesOnEachOther) {
  Mesh mesh;
  mesh.addQuad({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  mesh.addQuad({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  mesh.addQuad({0, 0, 0}, {0, 1, 0}, {1, 0, 0});
  const PlanarCharts found = mesh.charts();
  expectWhole(mesh, found);
  for (const PlanarChart& chart : found.charts) {
    float area = 0;
    for (const std::uint32_t t : chart.triangles) {
      const vec3 a = mesh.positions[mesh.indices[3 * t]];
      area += 0.5f * glm::length(glm::cross(mesh.positions[mesh.indices[3 * t + 1]] - a,
                                            mesh.positions[mesh.indices[3 * t + 2]] - a));
    }
    EXPECT_LE(area, chart.size.x * chart.size.y * 1.001f);
  }
  EXPECT_GE(found.charts.size(), 3u);
}

// Far too many for each to look at each.
TEST(PlanarCharts, TakeTimeByTheTriangleOfCopies) {
  constexpr std::uint32_t kCopies = 100'000;
  Mesh triangles;
  triangles.add({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  triangles.add({1, 0, 0}, {1, 1, 0}, {0, 1, 0});
  Mesh mesh = triangles;  // all copies of the first, then all of the second
  mesh.indices.clear();
  for (const std::size_t first : {0u, 3u})
    for (std::size_t i = 0; i < kCopies; ++i)
      mesh.indices.insert(mesh.indices.end(), &triangles.indices[first],
                          &triangles.indices[first] + 3);
  const PlanarCharts found = mesh.charts();
  ASSERT_EQ(found.charts.size(), kCopies);
  for (std::uint32_t i = 0; i < kCopies; ++i)
    ASSERT_EQ(found.charts[i].triangles, (std::vector<std::uint32_t>{i, i + kCopies}));
}

TEST(PlanarCharts, NameDegenerateTriangles) {
  Mesh mesh;
  mesh.addQuad({100, 0, 0}, {1, 0, 0}, {0, 1, 0});
  const float nan = std::numeric_limits<float>::quiet_NaN(),
              far = std::numeric_limits<float>::infinity();
  mesh.add({0, 0, 0}, {1, 0, 0}, {2, 0, 0});
  mesh.add({0, 0, 0}, {0, 0, 0}, {1, 0, 0});
  mesh.add({0, 0, nan}, {1, 0, 0}, {0, 1, 0});
  mesh.add({far, 0, 0}, {1, 0, 0}, {0, 1, 0});
  mesh.add({100, 0, 0}, {101, 0, 0}, {100.5f, 1e-7f, 0});  // below what a float tells there
  mesh.addQuad({0, 0, 0}, {1, 0, 0}, {0, 2, 0});
  const PlanarCharts found = mesh.charts();
  expectWhole(mesh, found);
  EXPECT_EQ(found.degenerate, (std::vector<std::uint32_t>{2, 3, 4, 5, 6}));
  ASSERT_EQ(found.charts.size(), 2u);
  EXPECT_EQ(found.charts[0].triangles, (std::vector<std::uint32_t>{7, 8}));
  EXPECT_EQ(found.charts[1].triangles, (std::vector<std::uint32_t>{0, 1}));
}

// Another object's triangles before or after change none.
TEST(PlanarCharts, OfAnObjectDoNotChangeWithOthers) {
  Mesh box, both;
  box.addBox({0, 0, 0}, {1, 2, 3});
  both.addBox({0, 0, 0}, {1, 2, 3});
  both.addBox({10, 0, 0}, {7, 7, 7});
  const PlanarCharts alone = box.charts(), together = both.charts();
  ASSERT_EQ(together.charts.size(), 12u);
  for (const PlanarChart& chart : alone.charts) {
    const auto same = std::ranges::find(together.charts, chart.triangles, &PlanarChart::triangles);
    ASSERT_NE(same, together.charts.end());
    EXPECT_EQ(same->origin, chart.origin);
    EXPECT_EQ(same->size, chart.size);
  }
}

}  // namespace
}  // namespace lucerna::bake
