#include "passes/shadow_layers/colour_lights.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "core/random.hpp"

namespace lucerna::passes {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;

OverlapGraph randomGraph(Random& random, std::size_t size, float density) {
  OverlapGraph graph(size);
  for (std::uint32_t a = 0; a < size; ++a)
    for (std::uint32_t b = a + 1; b < size; ++b)
      if (random.uniform() < density) {
        graph[a].push_back(b);
        graph[b].push_back(a);
      }
  return graph;
}

std::vector<int> colour(const OverlapGraph& graph, ColourOrder order, int layers = 32,
                        std::vector<std::uint32_t> first = {}) {
  return colourLights(graph, std::vector<bool>(graph.size(), true), first, order, layers);
}

int countOf(const std::vector<int>& layers) {
  return layers.empty() ? 0 : 1 + *std::ranges::max_element(layers);
}

bool isProper(const OverlapGraph& graph, const std::vector<int>& layers) {
  for (std::uint32_t a = 0; a < graph.size(); ++a)
    for (const std::uint32_t b : graph[a])
      if (layers[a] != kNoLayer && layers[a] == layers[b]) return false;
  return true;
}

// The fewest colours, by trying all.
bool colourable(const OverlapGraph& graph, int colours, std::vector<int>& layers,
                std::uint32_t vertex) {
  if (vertex == graph.size()) return true;
  for (int c = 0; c < colours; ++c) {
    const bool free = std::ranges::none_of(
        graph[vertex], [&](std::uint32_t n) { return n < vertex && layers[n] == c; });
    if (!free) continue;
    layers[vertex] = c;
    if (colourable(graph, colours, layers, vertex + 1)) return true;
  }
  return false;
}
int fewest(const OverlapGraph& graph) {
  std::vector<int> layers(graph.size());
  int colours = 0;
  while (!colourable(graph, colours, layers, 0)) ++colours;
  return colours;
}

TEST(ColourLights, NoTwoLightsThatOverlapShareALayer) {
  Random random(7);
  int degree = 0, saturation = 0, exact = 0;
  for (int i = 0; i < 300; ++i) {
    const OverlapGraph graph = randomGraph(random, 1 + random.below(9), random.uniform(0.1f, 0.9f));
    const std::vector<int> byDegree = colour(graph, ColourOrder::Degree);
    const std::vector<int> bySaturation = colour(graph, ColourOrder::Saturation);
    EXPECT_TRUE(isProper(graph, byDegree));
    EXPECT_TRUE(isProper(graph, bySaturation));
    EXPECT_EQ(std::ranges::count(byDegree, kNoLayer), 0);
    EXPECT_EQ(std::ranges::count(bySaturation, kNoLayer), 0);
    const int least = fewest(graph);
    EXPECT_GE(countOf(byDegree), least);
    EXPECT_GE(countOf(bySaturation), least);
    degree += countOf(byDegree), saturation += countOf(bySaturation), exact += least;
  }
  EXPECT_LE(saturation, exact + 5) << "DSATUR is all but exact on small graphs";
  EXPECT_GT(degree, saturation) << "the published order takes more";
}

TEST(ColourLights, SaturationIsExactOnBipartiteGraphs) {
  Random random(3);
  for (int i = 0; i < 50; ++i) {
    OverlapGraph graph(20);
    for (std::uint32_t a = 0; a < 10; ++a)
      for (std::uint32_t b = 10; b < 20; ++b)
        if (random.uniform() < 0.5f) graph[a].push_back(b), graph[b].push_back(a);
    EXPECT_LE(countOf(colour(graph, ColourOrder::Saturation)), 2);
  }
}

TEST(ColourLights, BeyondTheBoundLightsHaveNoLayer) {
  OverlapGraph all(6);
  for (std::uint32_t a = 0; a < 6; ++a)
    for (std::uint32_t b = 0; b < 6; ++b)
      if (a != b) all[a].push_back(b);
  for (const ColourOrder order : {ColourOrder::Degree, ColourOrder::Saturation}) {
    EXPECT_THAT(colour(all, order, 4), ElementsAre(0, 1, 2, 3, kNoLayer, kNoLayer));
    EXPECT_THAT(colour(all, order, 4, {5}), ElementsAre(1, 2, 3, kNoLayer, kNoLayer, 0));
  }
  EXPECT_THAT(colour(OverlapGraph(6), ColourOrder::Degree, 1), Each(0)) << "none overlap";
}

TEST(ColourLights, FirstLightsAreAlone) {
  const std::vector<int> layers = colour(OverlapGraph(4), ColourOrder::Saturation, 8, {2});
  EXPECT_THAT(layers, ElementsAre(1, 1, 0, 1));
}

scene::PlacedLight lamp(vec3 at, float reach, float cosOuter = -1.f) {
  scene::PlacedLight light;
  light.kind = cosOuter > -1.f ? scene::LightKind::Spot : scene::LightKind::Point;
  light.positionW = at;
  light.directionW = {0, -1, 0};
  light.reach = reach;
  light.cosOuter = cosOuter;
  return light;
}

TEST(ColourLights, LitSpheresHoldTheirCones) {
  Random random(5);
  for (int i = 0; i < 100; ++i) {
    const float cosOuter = random.uniform(-0.9f, 0.99f);
    const scene::PlacedLight light = lamp({1, 2, 3}, 4.f, cosOuter);
    const LitSphere sphere = litSphere(light);
    EXPECT_LE(sphere.radius, 4.f);
    const float angle = std::acos(random.uniform(cosOuter, 1.f));
    const vec3 direction(std::sin(angle), -std::cos(angle), 0);
    const vec3 point = light.positionW + random.uniform(0.f, 4.f) * direction;
    EXPECT_LE(glm::distance(point, sphere.centerW), sphere.radius + 1e-4f);
  }
}

TEST(ColourLights, OverlapsAreThoseOfLitVolumes) {
  scene::PlacedLight sun;
  sun.kind = scene::LightKind::Directional;
  sun.reach = std::numeric_limits<float>::infinity();
  const std::vector<scene::PlacedLight> lights{lamp({0, 0, 0}, 1.f), lamp({1.9f, 0, 0}, 1.f),
                                               lamp({4, 0, 0}, 1.f), sun, lamp({0, 0, 0.5f}, 1.f)};
  const OverlapGraph graph = overlapsOf(lights, {true, true, true, true, false});
  EXPECT_THAT(graph[0], ElementsAre(1, 3));
  EXPECT_THAT(graph[2], ElementsAre(3));
  EXPECT_THAT(graph[3], ElementsAre(0, 1, 2));
  EXPECT_THAT(graph[4], ElementsAre()) << "throws no shadow";
}

}  // namespace
}  // namespace lucerna::passes
