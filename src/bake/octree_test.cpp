// Leaves against a search among all triangles, and the octree's tracer against Embree's.
#include "bake/octree.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>

#include "bake/segment_test.hpp"
#include "bake/shadow_tracer.hpp"
#include "core/random.hpp"
#include "scene/builtin/builtin.hpp"

namespace lucerna::bake {
namespace {

using Triangles = std::vector<Octree::Corners>;

vec3 someVec(Random& random, float reach) {
  const float x = random.uniform(-reach, reach), y = random.uniform(-reach, reach);
  return {x, y, random.uniform(-reach, reach)};
}

Triangles soup(std::size_t count, float size) {
  Random random(count);
  Triangles triangles(count);
  for (Octree::Corners& corners : triangles) {
    const vec3 at = someVec(random, 5.f);
    for (vec3& corner : corners) corner = at + someVec(random, size);
  }
  return triangles;
}

// The triangles in the leaves along a segment; all leaves hold some.
std::set<std::uint32_t> visited(const Octree& octree, vec3 from, vec3 to) {
  std::set<std::uint32_t> found;
  EXPECT_FALSE(octree.visit(from, to, [&](std::span<const std::uint32_t> leaf) {
    EXPECT_FALSE(leaf.empty());
    found.insert(leaf.begin(), leaf.end());
    return false;
  }));
  return found;
}

// How many triangles are met; each of them is in a leaf along the segment.
int expectAllIn(const Octree& octree, const Triangles& triangles, vec3 from, vec3 to) {
  const std::set<std::uint32_t> found = visited(octree, from, to);
  const SegmentTest segment(from, to, 0.f);
  vec2 barycentric;
  int met = 0;
  for (std::uint32_t i = 0; i < triangles.size(); ++i)
    if (segment.meets(triangles[i], barycentric)) {
      EXPECT_TRUE(found.contains(i));
      ++met;
    }
  return met;
}

TEST(Octree, LeavesAlongASegmentHoldWhatItMeets) {
  for (const float size : {0.1f, 1.f, 6.f}) {
    const Triangles triangles = soup(500, size);
    const Octree octree(triangles, 4);
    Random random(1);
    int met = 0;
    for (int i = 0; i < 3000; ++i) {
      // From inside, from outside, and from very far.
      const vec3 from = someVec(random, i % 3 == 0 ? 4.f : i % 3 == 1 ? 15.f : 1e5f);
      vec3 to = someVec(random, 5.f);
      if (i % 5 == 0) to = triangles[random.below(500)][random.below(3)];
      if (i % 7 == 0) to[static_cast<int>(random.below(3))] = from.x;
      met += expectAllIn(octree, triangles, from, from + (to - from) * random.uniform(0.9f, 3.f));
    }
    EXPECT_GT(met, 100);
  }
}

// Triangles in the planes between cells, and segments in them, along edges and through corners.
TEST(Octree, PlanesBetweenCells) {
  Triangles triangles;
  Random random(2);
  const auto onGrid = [&] {
    return glm::round(someVec(random, 4.4f)) * (random.below(2) ? 1.f : 0.5f);
  };
  for (int i = 0; i < 400; ++i) triangles.push_back({onGrid(), onGrid(), onGrid()});
  for (const float side : {-4.f, 4.f}) triangles.push_back({vec3(side), vec3(side), vec3(side)});
  const Octree octree(triangles, 4);
  int met = 0;
  for (int i = 0; i < 3000; ++i) {
    const vec3 from = onGrid(), to = onGrid();
    met += expectAllIn(octree, triangles, from, to);
    met += expectAllIn(octree, triangles, from + vec3(0x1p-21f, 0, -0x1p-22f), to);
  }
  EXPECT_GT(met, 1000);
}

TEST(Octree, LeavesAreSmallWhereTrianglesAre) {
  const Triangles triangles = soup(5000, 0.05f);
  const Octree octree(triangles, 20);
  EXPECT_GT(octree.nodeCount(), 500u);
  EXPECT_LT(octree.nameCount(), 2 * triangles.size());
  Random random(3);
  for (int i = 0; i < 300; ++i)
    octree.visit(someVec(random, 6.f), someVec(random, 6.f),
                 [](std::span<const std::uint32_t> leaf) {
                   EXPECT_LE(leaf.size(), 20u);
                   return false;
                 });
}

TEST(Octree, VisitsFrontToBackAndStopsWhenTold) {
  Triangles triangles;
  for (int i = 0; i < 64; ++i) {
    const vec3 at(static_cast<float>(i), 0, 0);
    triangles.push_back({at, at + vec3(0.1f, 0.2f, 0), at + vec3(0, 0.1f, 0.2f)});
  }
  const Octree octree(triangles, 1);
  for (const bool back : {false, true}) {
    const vec3 from(back ? 70 : -1, 0.1f, 0.05f), to(back ? -1 : 70, 0.1f, 0.06f);
    std::vector<std::uint32_t> order;
    EXPECT_TRUE(octree.visit(from, to, [&](std::span<const std::uint32_t> leaf) {
      if (order.empty() || order.back() != leaf[0]) order.push_back(leaf[0]);
      return leaf[0] == 30;
    }));
    std::vector<std::uint32_t> expected;
    for (std::uint32_t i = back ? 63 : 0; i != 30; i += back ? -1 : 1) expected.push_back(i);
    expected.push_back(30);
    EXPECT_EQ(order, expected);
  }
}

TEST(Octree, ManyTrianglesInOnePlaceStayFew) {
  constexpr std::size_t kCount = 1'000'000;
  for (const float size : {1.f, 1e-6f}) {
    Triangles triangles(kCount, {vec3(0.1f), vec3(0.1f + size, 0.1f, 0.1f),
                                 vec3(0.1f, 0.1f + 0.7f * size, 0.1f + 0.2f * size)});
    triangles.push_back({vec3(-3), vec3(-3, -2, -3), vec3(-3, -3, -2)});
    triangles.push_back({vec3(3), vec3(3, 2, 3), vec3(3, 3, 2)});
    const Octree octree(triangles, 20);
    EXPECT_LE(octree.nameCount(), Octree::kMostNames * triangles.size());
    EXPECT_LT(octree.nodeCount(), 1000u);
    const vec3 middle = (triangles[0][0] + triangles[0][1] + triangles[0][2]) / 3.f;
    std::size_t most = 0;
    octree.visit(middle - vec3(0, 0, 2), middle + vec3(0, 0, 2), [&](auto leaf) {
      most = std::max(most, leaf.size());
      return false;
    });
    EXPECT_EQ(most, kCount);
    EXPECT_TRUE(visited(octree, {-2, -2, 2}, {2, -2, 2}).empty());
  }
}

TEST(Octree, WithoutTrianglesHasNoLeaves) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_TRUE(visited(Octree({}, 20), vec3(-1), vec3(1)).empty());
  const Triangles triangles{{vec3(0), vec3(1, 0, nan), vec3(0, 1, 0)},
                            {vec3(0), vec3(1e30f, 0, 0), vec3(0, 1, 0)}};
  EXPECT_TRUE(visited(Octree(triangles, 20), vec3(-1), vec3(1)).empty());
}

// Rays between random places near surfaces. Where one passes an edge or ends on a surface within
// Embree's single precision, the engines may differ: one ray in 20,000 at most.
void expectAgreement(const char* spec, float lift) {
  const Result<scene::Scene> scene = scene::makeBuiltin(spec);
  ASSERT_TRUE(scene);
  const World world = makeWorld(*scene);
  const auto embree = makeEmbreeTracer(world), octree = makeOctreeTracer(world);
  Random random(17);
  const auto place = [&] {
    const std::uint32_t t = random.below(static_cast<std::uint32_t>(world.triangleCount()));
    float u = random.uniform(), v = random.uniform();
    if (u + v > 1.f) u = 1.f - u, v = 1.f - v;
    const auto corner = [&](std::size_t k) { return world.positions[world.indices[3 * t + k]]; };
    return corner(0) * (1.f - u - v) + corner(1) * u + corner(2) * v + someVec(random, lift);
  };
  ShadowRays rays;
  rays.resize(200'000);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const vec3 from = place(), to = place();
    rays.fromX[i] = from.x, rays.fromY[i] = from.y, rays.fromZ[i] = from.z;
    rays.toX[i] = to.x, rays.toY[i] = to.y, rays.toZ[i] = to.z;
  }
  std::vector<vec3> first(rays.size()), second(rays.size());
  embree->trace(rays, first);
  octree->trace(rays, second);
  std::size_t apart = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) apart += glm::distance(first[i], second[i]) > 1e-4f;
  EXPECT_LE(apart, rays.size() / 20'000) << spec;
  const auto blocked = static_cast<std::size_t>(std::ranges::count(second, vec3(0.f)));
  EXPECT_GT(blocked, rays.size() / 20) << spec;
  EXPECT_LT(blocked, rays.size()) << spec;
}

TEST(OctreeTracer, AgreesWithEmbree) {
  expectAgreement("builtin:cornell", 0.01f);
  expectAgreement("builtin:materials", 0.1f);
  expectAgreement("builtin:nightcity?blocks=6", 0.3f);
}

}  // namespace
}  // namespace lucerna::bake
