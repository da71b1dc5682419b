// Widths of penumbrae against their closed form: by the three passes that make them.
#include <gtest/gtest.h>

#include <cmath>

#include "layer_stage.hpp"
#include "passes/nearest_blockers/nearest_blockers.hpp"
#include "passes/penumbra/penumbra.hpp"

namespace lucerna {
namespace {

constexpr uvec2 kSize{256, 64};
constexpr float kWall = testing::kHalfPlaneWall;
using testing::halfPlane;
using testing::kLampX;

// Stronger lamps behind the half-plane: their maps, which see no more than the wall, are placed
// before the first lamp's own in the same layer.
void addNeighbours(scene::Scene& scene) {
  scene::Light light = scene.lights[0];
  light.intensity = 200.f;
  for (const float y : {-0.5f, 0.f, 0.2f})
    testing::addLight(scene, light, {kLampX, y, -0.7f * kWall}, {kLampX, y, -kWall});
  updateTransforms(scene);
}

using Params = passes::Penumbra::Params;

const passes::ShadowMaps::Params kLargeMaps{.localSize = 2048, .localMemory = 512};

// Of the first light in the middle row, m.
std::vector<float> widthsOf(const testing::LayerStage& stage, const Params& params) {
  graph::PassContext context{.device = testing::device()};

  render::NearestBlockers nearest;
  passes::NearestBlockers::Ports nearestPorts;
  nearestPorts.shadowMaps.bind(&stage.maps);
  nearestPorts.nearestBlockers.bind(&nearest);
  passes::NearestBlockers(testing::device()).execute(context, {}, nearestPorts);

  render::Penumbrae penumbrae;
  passes::Penumbra::Ports ports;
  stage.bind(ports);
  if (params.method == passes::Penumbra::Method::Minimum) ports.nearestBlockers.bind(&nearest);
  ports.penumbrae.bind(&penumbrae);
  passes::Penumbra(testing::device()).execute(context, params, ports);
  EXPECT_EQ(penumbrae.layers, stage.layers.count);
  const int layer = stage.layers.ofLight[0];
  const Image image =
      converted(testing::device().download(penumbrae.widths, layer / 4), ComponentType::F32, 4);
  std::vector<float> widths;
  for (int x = 0; x < image.width(); ++x)
    widths.push_back(image.pixel<float>(x, image.height() / 2)[layer % 4]);
  return widths;
}

std::vector<float> widthsOf(const scene::Scene& scene, const Params& params) {
  return widthsOf(testing::LayerStage(scene, kSize, kLargeMaps), params);
}

// The middle of the penumbra is as far behind the edge as the lamp is before it.
float middleOf(const scene::Scene& scene, const std::vector<float>& widths) {
  const float aspect = static_cast<float>(kSize.x) / static_cast<float>(kSize.y);
  const float metres = 2.f * kWall * std::tan(0.5f * scene.cameras[0].fovY) * aspect;
  return widths[static_cast<std::size_t>((0.5f - kLampX / metres) *
                                         static_cast<float>(widths.size()))];
}

void expectThoseOfADisc(const Params& params) {
  std::vector<double> found;
  const std::vector<float> radii{0.1f, 0.2f, 0.4f, 0.8f};
  for (const float radius : radii) {
    SCOPED_TRACE(radius);
    const scene::Scene scene = halfPlane(radius);
    const std::vector<float> widths = widthsOf(scene, params);
    found.push_back(middleOf(scene, widths));
    EXPECT_NEAR(found.back(), 2.f * radius, 0.1f * 2.f * radius);
    EXPECT_EQ(widths.back(), 0.f) << "nothing is in the way there";
  }
  const double exponent = std::log(found.back() / found.front()) /
                          std::log(static_cast<double>(radii.back() / radii.front()));
  EXPECT_NEAR(exponent, 1., 0.03);
  testing::expectNoDebugMessages();
}

TEST(PenumbraWidths, OfASearchAreThoseOfADiscAndLinearInItsSize) {
  Params params;
  params.search = 11;
  for (const auto resolution : {render::LayerResolution::Half, render::LayerResolution::Full}) {
    params.resolution = resolution;
    expectThoseOfADisc(params);
  }
}

TEST(PenumbraWidths, OfNearestBlockersAreThoseOfADiscAndLinearInItsSize) {
  Params params;
  params.method = passes::Penumbra::Method::Minimum;
  expectThoseOfADisc(params);
}

// Small maps lie side by side: windows end at their edges, and levels of blocks at their size.
TEST(PenumbraWidths, AreThoseOfALampByItselfWhereItsMapHasNeighbours) {
  const scene::Scene alone = halfPlane(0.4f);
  scene::Scene together = alone;
  addNeighbours(together);
  // Enough for one map of 512 x 512 texels, and for four of them.
  const testing::LayerStage ofOne(alone, kSize, {.localSize = 2048, .localMemory = 1});
  const testing::LayerStage ofFour(together, kSize, {.localSize = 2048, .localMemory = 4});
  for (const testing::LayerStage* stage : {&ofOne, &ofFour}) {
    const auto& place = stage->maps.maps[stage->maps.ofLight[0].first].place;
    EXPECT_EQ(place.side, 512);
    EXPECT_EQ(place.corner == ivec2(0), stage == &ofOne);
  }
  Params params;
  for (const auto method : {passes::Penumbra::Method::Search, passes::Penumbra::Method::Minimum}) {
    params.method = method;
    const std::vector<float> wanted = widthsOf(ofOne, params), found = widthsOf(ofFour, params);
    EXPECT_EQ(found, wanted);
    EXPECT_GT(std::ranges::max(found), 0.5f);
    EXPECT_EQ(std::ranges::min(found), 0.f);
  }
}

// As published, the light's size in m is a factor twice.
TEST(PenumbraWidths, AsPublishedGrowWithTheSquareOfTheLightsSize) {
  for (const auto method : {passes::Penumbra::Method::Search, passes::Penumbra::Method::Minimum})
    for (const float radius : {0.1f, 0.4f}) {
      Params params;
      params.method = method;
      const scene::Scene scene = halfPlane(radius);
      const std::vector<float> mended = widthsOf(scene, params);
      params.variant = render::LayeredVariant::Published;
      const std::vector<float> published = widthsOf(scene, params);
      EXPECT_GT(std::ranges::max(mended), radius);
      for (std::size_t i = 0; i < mended.size(); ++i)
        ASSERT_NEAR(published[i], mended[i] * 2.f * radius, 2e-3f * mended[i]) << i;
    }
  testing::expectNoDebugMessages();
}

// As published, lights that overlap have one layer with the mean of their widths.
TEST(PenumbraWidths, OfOneLayerForAllLightsAreTheirMean) {
  scene::Scene scene = halfPlane(0.1f);
  scene::Light large = scene.lights[0];
  large.radius = 0.5f;
  testing::addLight(scene, large, {kLampX, 0.5f, 0}, {kLampX, 0.5f, -kWall});
  updateTransforms(scene);
  const testing::LayerStage mended(scene, kSize, kLargeMaps);
  const testing::LayerStage published(scene, kSize, kLargeMaps,
                                      {.variant = render::LayeredVariant::Published});
  EXPECT_EQ(mended.layers.count, 2);
  EXPECT_FALSE(mended.layers.shared);
  EXPECT_EQ(published.layers.count, 1);
  EXPECT_EQ(published.layers.ofLight, (std::vector{0, 0}));
  EXPECT_TRUE(published.layers.shared);
  EXPECT_NEAR(middleOf(scene, widthsOf(mended, {})), 2 * 0.1f, 0.02f);
  EXPECT_NEAR(middleOf(scene, widthsOf(published, {})), 0.1f + 0.5f, 0.06f);
  testing::expectNoDebugMessages();
}

}  // namespace
}  // namespace lucerna
