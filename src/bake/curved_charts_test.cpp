// Charts of surfaces whose shapes are known, measured without the code that makes them.
#include "bake/curved_charts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <set>

#include "bake/chart_overlap.hpp"
#include "bake/triangle_soup.hpp"
#include "core/parallel.hpp"

namespace lucerna::bake {
namespace {

using Flat = std::array<vec2, 3>;

struct Mesh : TriangleSoup {
  // at(i / across, j / up): a grid of quads, each of two triangles.
  void addGrid(int across, int up, const std::function<vec3(float, float)>& at) {
    const auto corner = [&](int i, int j) {
      return at(static_cast<float>(i) / static_cast<float>(across),
                static_cast<float>(j) / static_cast<float>(up));
    };
    for (int j = 0; j < up; ++j)
      for (int i = 0; i < across; ++i) {
        add(corner(i, j), corner(i + 1, j), corner(i + 1, j + 1));
        add(corner(i, j), corner(i + 1, j + 1), corner(i, j + 1));
      }
  }
  std::array<glm::dvec3, 3> triangle(std::uint32_t t) const {
    return {glm::dvec3(positions[indices[3 * t]]), glm::dvec3(positions[indices[3 * t + 1]]),
            glm::dvec3(positions[indices[3 * t + 2]])};
  }
  double areaOf(std::uint32_t t) const {
    const auto [a, b, c] = triangle(t);
    return glm::length(glm::cross(b - a, c - a)) / 2;
  }
  CurvedCharts charts(const CurvedSettings& settings = {}) const {
    return curvedCharts(positions, indices, settings);
  }
};

// Turns of whole circles meet themselves to the bit.
vec2 onCircle(float share) {
  const float angle = 2 * kPi * (share - std::floor(share));
  return {std::cos(angle), std::sin(angle)};
}

Mesh sphere(int rings) {
  Mesh mesh;
  mesh.addGrid(2 * rings, rings, [](float u, float v) {
    const vec2 around = onCircle(u);
    const float ring = v == 0.f || v == 1.f ? 0.f : std::sin(kPi * v);
    return vec3(ring * around.x, -std::cos(kPi * v), -ring * around.y);
  });
  return mesh;
}

Mesh torus(int steps) {
  Mesh mesh;
  mesh.addGrid(2 * steps, steps, [](float u, float v) {
    const vec2 around = onCircle(u), within = onCircle(v);
    return vec3((2 + 0.7f * within.x) * around.x, 0.7f * within.y,
                -(2 + 0.7f * within.x) * around.y);
  });
  return mesh;
}

Mesh cylinder(int steps) {
  Mesh mesh;
  mesh.addGrid(steps, 3, [](float u, float v) {
    const vec2 around = onCircle(u);
    return vec3(around.x, 3 * v, -around.y);
  });
  return mesh;
}

Mesh terrain(int steps) {
  Mesh mesh;
  mesh.addGrid(steps, steps, [](float u, float v) {
    return vec3(20 * u, std::sin(9 * u) * std::cos(7 * v) + 0.3f * std::sin(31 * u + 17 * v),
                -20 * v);
  });
  return mesh;
}

// Turned by half on its way around, and closed.
Mesh mobiusStrip(int steps) {
  Mesh mesh;
  mesh.addGrid(steps, 4, [](float u, float v) {
    const float turn = u == 1.f ? 0.f : kPi * u, side = u == 1.f ? 0.5f - v : v - 0.5f;
    const vec2 around = onCircle(u);
    const float radius = 2 + side * std::cos(turn);
    return vec3(radius * around.x, side * std::sin(turn), -radius * around.y);
  });
  return mesh;
}

// How much the map from a triangle in space to the plane lengthens least and most: the roots of
// det(flat - x * space) of the two Gram matrices of its sides.
std::array<double, 2> stretches(const std::array<glm::dvec3, 3>& space, const Flat& flat) {
  const glm::dvec3 a = space[1] - space[0], b = space[2] - space[0];
  const glm::dvec2 p(glm::dvec2(flat[1]) - glm::dvec2(flat[0])),
      q(glm::dvec2(flat[2]) - glm::dvec2(flat[0]));
  const double aa = glm::dot(a, a), ab = glm::dot(a, b), bb = glm::dot(b, b);
  const double pp = glm::dot(p, p), pq = glm::dot(p, q), qq = glm::dot(q, q);
  const double second = aa * bb - ab * ab, middle = (pp * bb + qq * aa - 2 * pq * ab) / 2,
               last = pp * qq - pq * pq;
  const double root = std::sqrt(std::max(0., middle * middle - second * last));
  return {std::sqrt(std::max(0., (middle - root) / second)), std::sqrt((middle + root) / second)};
}

double areaOf(const Flat& t) {
  const glm::dvec2 u = glm::dvec2(t[1]) - glm::dvec2(t[0]), v = glm::dvec2(t[2]) - glm::dvec2(t[0]);
  return (u.x * v.y - u.y * v.x) / 2;
}

// Whether p lies inside by more than `margin`.
bool holds(const Flat& t, glm::dvec2 p, double margin) {
  for (std::size_t k = 0; k < 3; ++k) {
    const glm::dvec2 side = glm::dvec2(t[(k + 1) % 3]) - glm::dvec2(t[k]),
                     to = p - glm::dvec2(t[k]);
    if (side.x * to.y - side.y * to.x <= margin * glm::length(side)) return false;
  }
  return true;
}

// Points of a fine grid that more than one triangle holds.
int pointsTwice(const std::vector<Flat>& triangles, vec2 size) {
  constexpr int kPoints = 400;
  const double step = std::max(size.x, size.y) / kPoints;
  std::vector<int> seen((kPoints + 2) * (kPoints + 2), 0);
  for (const Flat& t : triangles) {
    const glm::dvec2 low = glm::min(glm::min(t[0], t[1]), t[2]),
                     high = glm::max(glm::max(t[0], t[1]), t[2]);
    for (int y = static_cast<int>(low.y / step); y <= static_cast<int>(high.y / step); ++y)
      for (int x = static_cast<int>(low.x / step); x <= static_cast<int>(high.x / step); ++x)
        if (holds(t, {(x + 0.37) * step, (y + 0.59) * step}, 0.02 * step))
          ++seen[static_cast<std::size_t>(y * (kPoints + 2) + x)];
  }
  return static_cast<int>(std::ranges::count_if(seen, [](int n) { return n > 1; }));
}

struct Measured {
  double least = 1, most = 1, area = 0, flatArea = 0;
};

// What must hold of all charts.
Measured expectSound(const Mesh& mesh, const CurvedCharts& found, double mostStretch = 2) {
  Measured result;
  std::multiset<std::uint32_t> seen(found.degenerate.begin(), found.degenerate.end());
  for (const CurvedChart& chart : found.charts) {
    EXPECT_TRUE(std::ranges::is_sorted(chart.triangles));
    EXPECT_EQ(chart.triangles.size(), chart.corners.size());
    seen.insert(chart.triangles.begin(), chart.triangles.end());
    vec2 low(1e30f), high(-1e30f);
    for (std::size_t i = 0; i < chart.triangles.size(); ++i) {
      const Flat& flat = chart.corners[i];
      const auto [least, most] = stretches(mesh.triangle(chart.triangles[i]), flat);
      EXPECT_GT(areaOf(flat), 0) << "flipped";
      result.least = std::min(result.least, least), result.most = std::max(result.most, most);
      result.area += mesh.areaOf(chart.triangles[i]), result.flatArea += areaOf(flat);
      for (const vec2 p : flat) low = glm::min(low, p), high = glm::max(high, p);
    }
    EXPECT_EQ(pointsTwice(chart.corners, chart.size), 0);
    for (int c = 0; c < 2; ++c) {
      EXPECT_NEAR(low[c], 0, 1e-5 * chart.size[c]);
      EXPECT_NEAR(high[c], chart.size[c], 1e-5 * chart.size[c]);
    }
  }
  EXPECT_GT(result.least, 1 / mostStretch - 1e-3);
  EXPECT_LT(result.most, mostStretch + 1e-3);
  EXPECT_EQ(seen.size(), mesh.indices.size() / 3);
  std::uint32_t expected = 0;
  for (const std::uint32_t triangle : seen) EXPECT_EQ(triangle, expected++);
  return result;
}

void expectSame(const CurvedChart& a, const CurvedChart& b) {
  EXPECT_EQ(a.triangles, b.triangles);
  EXPECT_EQ(a.corners, b.corners);
  EXPECT_EQ(a.size, b.size);
}

TEST(CurvedCharts, UnrollACylinder) {
  const Mesh mesh = cylinder(48);
  const CurvedCharts found = mesh.charts();
  const Measured measured = expectSound(mesh, found);
  EXPECT_NEAR(measured.least, 1, 1e-3);
  EXPECT_NEAR(measured.most, 1, 1e-3);
  EXPECT_NEAR(measured.flatArea / measured.area, 1, 1e-4);
  EXPECT_LE(found.charts.size(), 6u);
  for (const CurvedChart& chart : found.charts)
    EXPECT_NEAR(std::max(chart.size.x, chart.size.y), 3, 2e-3);
}

// Which the first step of the solver brings into one plane, and no further step may spoil.
TEST(CurvedCharts, UnfoldPairs) {
  for (int i = 0; i < 200; ++i) {
    SCOPED_TRACE(i);
    const float x = 0.1f + 0.037f * static_cast<float>(i % 7),
                y = 0.05f + 0.11f * static_cast<float>(i % 11);
    Mesh mesh;
    mesh.add({0, 0, 0}, {1, 0, 0}, {x, 0.1f, -y});
    mesh.add({1, 0, 0}, {0, 0, 0}, {1 - y, 0.2f, 0.3f + x});
    const CurvedCharts found = mesh.charts();
    const Measured measured = expectSound(mesh, found);
    EXPECT_NEAR(measured.least, 1, 1e-3);
    EXPECT_NEAR(measured.most, 1, 1e-3);
  }
}

TEST(CurvedCharts, CoverASphereWithFew) {
  const Mesh mesh = sphere(24);
  const CurvedCharts found = mesh.charts();
  const Measured measured = expectSound(mesh, found);
  EXPECT_NEAR(measured.flatArea / measured.area, 1, 1e-3);
  EXPECT_LE(found.charts.size(), 16u);
  EXPECT_GE(found.charts.size(), 4u);
  EXPECT_GT(measured.most, 1.01);  // no plane is like a sphere
  EXPECT_LT(measured.most, 1.4);
}

TEST(CurvedCharts, CoverATorus) {
  const Mesh mesh = torus(24);
  const CurvedCharts found = mesh.charts();
  const Measured measured = expectSound(mesh, found);
  EXPECT_NEAR(measured.flatArea / measured.area, 1, 1e-3);
  EXPECT_LE(found.charts.size(), 48u);
}

TEST(CurvedCharts, LayBumpyGroundInLargeOnes) {
  const Mesh mesh = terrain(48);
  const CurvedCharts found = mesh.charts();
  const Measured measured = expectSound(mesh, found);
  EXPECT_NEAR(measured.flatArea / measured.area, 1, 1e-3);
  EXPECT_LE(found.charts.size(), 4u);
}

TEST(CurvedCharts, GrowNoLongerThanAllowed) {
  const Mesh mesh = terrain(48);
  const CurvedCharts found = mesh.charts({.growth = {.longest = 8}});
  expectSound(mesh, found);
  EXPECT_GE(found.charts.size(), 12u);
  for (const CurvedChart& chart : found.charts) EXPECT_LT(glm::length(chart.size), 12);
}

TEST(CurvedCharts, CutAStripOfOneSide) {
  const Mesh mesh = mobiusStrip(60);
  const Measured measured = expectSound(mesh, mesh.charts());
  EXPECT_LT(measured.most, 1.2);
}

TEST(CurvedCharts, OfACubeAreItsSides) {
  Mesh mesh;
  const vec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  const auto side = [&](vec3 corner, vec3 u, vec3 v) {
    mesh.addGrid(3, 3, [=](float s, float t) { return corner + s * u + t * v; });
  };
  side({0, 0, 0}, y, x), side({0, 0, 0}, z, y), side({0, 0, 0}, x, z);
  side({1, 1, 1}, -x, -y), side({1, 1, 1}, -y, -z), side({1, 1, 1}, -z, -x);
  const CurvedCharts found = mesh.charts();
  const Measured measured = expectSound(mesh, found, 1.0001);
  EXPECT_NEAR(measured.flatArea, 6, 1e-4);
  ASSERT_EQ(found.charts.size(), 6u);
  for (const CurvedChart& chart : found.charts) {
    EXPECT_NEAR(chart.size.x * chart.size.y, 1, 1e-5);
    EXPECT_NEAR(glm::length(chart.normal), 1, 1e-5);
  }
}

// A roof of two slopes is one chart or two, as its ridge is smooth or sharp.
TEST(CurvedCharts, BreakAtCreases) {
  for (const float degrees : {20.f, 60.f}) {
    Mesh mesh;
    const float angle = degrees * kPi / 180;
    mesh.addGrid(1, 1, [](float u, float v) { return vec3(u, 0, -v); });
    mesh.addGrid(1, 1, [&](float u, float v) {
      return vec3(1 + u * std::cos(angle), u * std::sin(angle), -v);
    });
    const CurvedCharts found = mesh.charts();
    expectSound(mesh, found, 1.001);
    EXPECT_EQ(found.charts.size(), degrees < 40 ? 1u : 2u);
  }
}

// A ramp around a pillar passes over itself: within the cone, and yet no chart.
TEST(CurvedCharts, CutWhatPassesOverItself) {
  Mesh mesh;
  mesh.addGrid(120, 3, [](float u, float v) {
    const float angle = 2 * kPi * 2.5f * u;
    return vec3((2 + v) * std::cos(angle), 4 * u, -(2 + v) * std::sin(angle));
  });
  const CurvedCharts found = mesh.charts({.growth = {.compact = 1e9f}});
  expectSound(mesh, found);
  EXPECT_GT(found.charts.size(), 2u);
  EXPECT_LE(found.charts.size(), 12u);
}

TEST(CurvedCharts, KeepCopiesApart) {
  Mesh mesh = sphere(12);
  const Mesh once = mesh;
  for (const std::uint32_t i : once.indices) {
    mesh.indices.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
    mesh.positions.push_back(once.positions[i]);
  }
  const Measured measured = expectSound(mesh, mesh.charts());
  EXPECT_NEAR(measured.flatArea / measured.area, 1, 1e-3);
}

// Three sheets on one edge, and one triangle many times over.
TEST(CurvedCharts, TakeEdgesThatManyShare) {
  Mesh mesh;
  for (const float turn : {0.f, 0.4f, 2.f, 4.f})
    mesh.addGrid(4, 4, [=](float u, float v) {
      const float angle = turn + 0.3f * u;
      return vec3(u * std::cos(angle), u * std::sin(angle), -v);
    });
  for (int copy = 0; copy < 100; ++copy) mesh.add({9, 0, 0}, {10, 0, 0}, {9, 0, -1});
  const CurvedCharts found = mesh.charts();
  expectSound(mesh, found);
  EXPECT_GE(found.charts.size(), 103u);
}

TEST(CurvedCharts, NameDegenerateTriangles) {
  Mesh mesh;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  mesh.add({0, 0, 0}, {1, 0, 0}, {2, 0, 0});
  mesh.add({0, 0, nan}, {1, 0, 0}, {0, 1, 0});
  mesh.addGrid(2, 2, [](float u, float v) { return vec3(u, 0.2f * u * u, -v); });
  mesh.add({0, 0, 0}, {0, 0, 0}, {1, 0, 0});
  const CurvedCharts found = mesh.charts();
  EXPECT_EQ(found.degenerate, (std::vector<std::uint32_t>{0, 1, 10}));
  std::size_t others = 0;
  for (const CurvedChart& chart : found.charts) others += chart.triangles.size();
  EXPECT_EQ(others, 8u);
  EXPECT_TRUE(curvedCharts({}, {}).charts.empty());
}

// To the bit, with triangles elsewhere and with any number of threads.
TEST(CurvedCharts, DependOnNothingElse) {
  const Mesh alone = terrain(24);
  Mesh more = torus(16);
  for (vec3& p : more.positions) p += vec3(100, 0, 0);
  Mesh both = alone;
  for (const std::uint32_t i : more.indices) {
    both.indices.push_back(static_cast<std::uint32_t>(both.positions.size()));
    both.positions.push_back(more.positions[i]);
  }
  const int threads = threadCount();
  setThreadCount(1);
  const CurvedCharts first = alone.charts();
  setThreadCount(4);
  const CurvedCharts together = both.charts();
  setThreadCount(threads);
  ASSERT_GT(together.charts.size(), first.charts.size());
  for (std::size_t i = 0; i < first.charts.size(); ++i)
    expectSame(first.charts[i], together.charts[i]);
}

TEST(Overlap, IsWhatLiesInside) {
  using Triangle = std::array<glm::dvec2, 3>;
  const Triangle one{{{0, 0}, {1, 0}, {0, 1}}}, beside{{{1, 0}, {1, 1}, {0, 1}}};
  EXPECT_FALSE(findOverlap(std::array{one, beside}, 1e-9));
  EXPECT_TRUE(findOverlap(std::array{one, one}, 1e-9));
  const Triangle inside{{{0.2, 0.2}, {0.3, 0.2}, {0.2, 0.3}}};
  EXPECT_TRUE(findOverlap(std::array{one, inside}, 1e-9));
  for (const double shift : {-0.01, 0.01}) {  // away from, and over, the long side
    Triangle moved = beside;
    for (glm::dvec2& p : moved) p -= shift;
    EXPECT_EQ(findOverlap(std::array{one, moved}, 1e-3).has_value(), shift > 0);
    EXPECT_FALSE(findOverlap(std::array{one, moved}, 0.1));
  }
  // A cross, of which no corner is inside.
  const Triangle flat{{{-5, 0}, {5, -0.1}, {5, 0.1}}}, upright{{{0.1, -5}, {0, 5}, {-0.1, -5}}};
  EXPECT_TRUE(findOverlap(std::array{flat, upright}, 1e-3));
}

}  // namespace
}  // namespace lucerna::bake
