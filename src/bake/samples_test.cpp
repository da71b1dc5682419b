#include "bake/samples.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "bake/light_scenes.hpp"
#include "bake/triangle.hpp"
#include "core/random.hpp"

namespace lucerna::bake {
namespace {

using namespace testing;

// Rectangles askew, one of them mirrored by its node, and a bent strip with smooth normals.
struct Pieces {
  scene::Scene scene;
  World world;
  Charts charts;
  std::uint32_t mirrored;

  Pieces() {
    addSurface(scene);
    addRectangle(scene, {1, 2, 3}, {1.3f, 0.2f, 0}, {-0.1f, 0.65f, 0.4f});
    mirrored = addRectangle(scene, {-2, 0.5f, 0}, {0.4f, 0, 0.3f}, {0, 0.7f, 0});
    scene.nodes[scene.objects[mirrored].node].scale = {-1.f, 1.f, 1.f};
    addStrip();
    updateTransforms(scene);
    world = makeWorld(scene);
    charts = makeCharts(world, {.density = 9.3f});
  }
  void addStrip() {
    addRectangle(scene, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    scene::Mesh& mesh = scene.meshes.back();
    mesh.positions.clear(), mesh.normals.clear(), mesh.texCoords[0].clear(), mesh.indices.clear();
    constexpr std::uint32_t kSteps = 8;
    for (std::uint32_t i = 0; i <= kSteps; ++i)
      for (const float y : {0.f, 1.f}) {
        const float angle = 0.8f * static_cast<float>(i) / kSteps;
        mesh.normals.emplace_back(std::sin(angle), 0, std::cos(angle));
        mesh.positions.push_back(2.f * mesh.normals.back() + vec3(0, y, 0));
      }
    for (std::uint32_t i = 0; i < 2 * kSteps; i += 2)
      for (const std::uint32_t k : {0u, 2u, 3u, 0u, 3u, 1u}) mesh.indices.push_back(i + k);
  }
  std::vector<Block> blocks() const {
    std::vector<Block> list;
    for (std::uint32_t i = 0; i < charts.charts.size(); ++i) addBlocks(list, charts.charts[i], i);
    return list;
  }
};

// Where a sample lies in its chart, by its triangle.
vec2 placeOf(const Samples& s, std::size_t i, const Chart& chart) {
  const auto& c = chart.corners[s.triangles[i]];
  const vec2 b = s.barycentrics[i];
  return c[0] + b.x * (c[1] - c[0]) + b.y * (c[2] - c[0]);
}

TEST(ChartSampler, PutsSamplesOnTheirTriangles) {
  const Pieces pieces;
  std::size_t count = 0;
  for (const int side : {1, 4})
    for (const Block& block : pieces.blocks()) {
      const Chart& chart = pieces.charts.charts[block.chart];
      const WorldObject& object = pieces.world.objects[chart.object];
      const auto indices = pieces.world.indicesOf(object);
      Samples s;
      ChartSampler(pieces.world, chart, side).sample(block, s);
      for (std::size_t i = 0; i < s.size(); ++i, ++count) {
        const vec2 b = s.barycentrics[i];
        EXPECT_GE(std::min({b.x, b.y, 1 - b.x - b.y}), -1e-5f);
        std::array<vec3, 3> corners;
        for (std::size_t k = 0; k < 3; ++k)
          corners[k] =
              pieces.world.positions[indices[3 * std::size_t{chart.triangles[s.triangles[i]]} + k]];
        const vec3 on =
            corners[0] + b.x * (corners[1] - corners[0]) + b.y * (corners[2] - corners[0]);
        const vec3 flat = (object.mirrored ? -1.f : 1.f) * shapeOf(corners).normal;
        const vec3 off = vec3(s.x[i], s.y[i], s.z[i]) - on;
        // Just off the front, straight up.
        EXPECT_GT(glm::dot(off, flat), 0.f);
        EXPECT_LT(glm::length(off), 2 * liftAt(vec3(5)));
        EXPECT_LT(glm::length(off - flat * glm::dot(off, flat)), 2e-6f);
        // In its texel.
        const vec2 in = placeOf(s, i, chart) - vec2(block.corner) -
                        vec2(s.texels[i] % block.size.x, s.texels[i] / block.size.x);
        EXPECT_GE(std::min(in.x, in.y), -1e-4f);
        EXPECT_LE(std::max(in.x, in.y), 1 + 1e-4f);
        // Of bent surfaces, between the normals of the corners.
        EXPECT_GT(glm::dot(vec3(s.nx[i], s.ny[i], s.nz[i]), flat), 0.99f);
      }
    }
  EXPECT_GT(count, 5000u);
}

TEST(ChartSampler, AMirroredObjectsFrontIsWhereItsNormalsPoint) {
  const Pieces pieces;
  int found = 0;
  for (const Block& block : pieces.blocks()) {
    const Chart& chart = pieces.charts.charts[block.chart];
    if (chart.object != pieces.mirrored) continue;
    Samples s;
    ChartSampler(pieces.world, chart, 1).sample(block, s);
    // The mesh faces cross((0.4, 0, 0.3), (0, 0.7, 0)) = (-0.21, 0, 0.28), mirrored in x.
    for (std::size_t i = 0; i < s.size(); ++i, ++found)
      EXPECT_LT(glm::length(vec3(s.nx[i], s.ny[i], s.nz[i]) - vec3(0.6f, 0, 0.8f)), 1e-5f);
    EXPECT_TRUE(s.planar);
  }
  EXPECT_GT(found, 50);
}

// A texel that no place of the pattern lies in, and yet touched: the middle of what is covered.
TEST(ChartSampler, BorderTexelsHaveTheirCentroid) {
  scene::Scene scene;
  addSurface(scene);
  addRectangle(scene, {0.165f, 0.5f, 0}, {0.165f, 0, 0}, {0, 0.5f, 0});  // 3.3 by 10 texels
  const World world = makeWorld(scene);
  const Charts charts = makeCharts(world, {.density = 10.f});
  ASSERT_EQ(charts.charts.size(), 1u);
  const Chart& chart = charts.charts[0];
  const int across = chart.size.x < chart.size.y ? 0 : 1;
  Samples s;
  ChartSampler(world, chart, 1).sample({.size = chart.size}, s);
  EXPECT_EQ(s.size(), 40u);
  int border = 0;
  for (std::size_t i = 0; i < s.size(); ++i) {
    const ivec2 texel(s.texels[i] % chart.size.x, s.texels[i] / chart.size.x);
    if (texel[across] != 3) continue;
    ++border;
    EXPECT_LT(s.areas[i], 0.31f);
    // Of a texel that the diagonal cuts, the larger part counts.
    EXPECT_NEAR(placeOf(s, i, chart)[across], 3.15f, 0.06f);
  }
  EXPECT_EQ(border, 10);
}

TEST(ChartSampler, ATexelsPlacesFallIntoRowsAndColumnsOfTheirOwn) {
  scene::Scene scene;
  addSurface(scene);
  addRectangle(scene, {0.5f, 0.5f, 0}, {0.5f, 0, 0}, {0, 0.5f, 0});
  const World world = makeWorld(scene);
  const Charts charts = makeCharts(world, {.density = 8.f});
  const Chart& chart = charts.charts.at(0);
  Samples s;
  ChartSampler(world, chart, 4).sample({.size = chart.size}, s);
  ASSERT_EQ(s.size(), 64u * 16u);
  for (const int axis : {0, 1}) {
    std::map<std::pair<int, int>, int> counts;  // of a texel and a sixteenth
    for (std::size_t i = 0; i < s.size(); ++i) {
      const float p = placeOf(s, i, chart)[axis];
      ++counts[{s.texels[i], static_cast<int>(std::floor(16 * (p - std::floor(p))))}];
    }
    EXPECT_EQ(counts.size(), 64u * 16u);
  }
}

// However the plane lies, blocks of many samples too.
TEST(ChartSampler, FlatBlocksAreKnownAsFlat) {
  Random random(9);
  for (int k = 0; k < 100; ++k) {
    scene::Scene scene;
    addSurface(scene);
    const auto any = [&](float half) {
      return vec3(random.uniform(-half, half), random.uniform(-half, half),
                  random.uniform(-half, half));
    };
    const vec3 u = glm::normalize(any(1)), v = any(1);
    addRectangle(scene, any(k % 2 ? 2.f : 500.f), u, glm::normalize(v - u * glm::dot(u, v)));
    const World world = makeWorld(scene);
    const Charts charts = makeCharts(world, {.density = 10.f});
    Samples s;
    ChartSampler(world, charts.charts.at(0), 4).sample({.size = charts.charts[0].size}, s);
    EXPECT_TRUE(s.planar) << k;
  }
}

}  // namespace
}  // namespace lucerna::bake
