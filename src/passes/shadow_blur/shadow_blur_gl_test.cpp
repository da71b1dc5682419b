// Soft shadows in layers, beside percentage-closer ones, against what is known of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/testing.hpp"

namespace lucerna {
namespace {

constexpr float kWall = 6.f;  // m before the camera

void addLamp(scene::Scene& scene, vec3 eye, vec3 target) {
  scene::Light light;
  light.kind = scene::LightKind::Spot;
  light.intensity = 100.f;
  light.outerCone = 1.f;
  light.innerCone = 0.9f;
  testing::addLight(scene, light, eye, target);
}

// A spot lamp, a disc, beside the camera throws the shadow of a half-plane onto a wall. Of how much
// of the disc one sees where is known; t: place in the penumbra, -1 to 1.
double visibleShareOfDisc(double t) {
  t = std::clamp(t, -1., 1.);
  return 0.5 + (t * std::sqrt(1. - t * t) + std::asin(t)) / static_cast<double>(kPi);
}

// shadows: of TiledLighting, with what it needs.
graph::Pipeline softRows(const std::string& shadows) {
  std::vector<std::string> types{"Cull", "GBuffer", "ShadowMaps", "TileLights", "TiledLighting"};
  if (shadows == "none") std::erase(types, "ShadowMaps");
  if (shadows == "layered")
    types.insert(types.end() - 1, {"ShadowLayers", "ShadowMask", "Penumbra", "ShadowBlur"});
  if (shadows == "prefiltered") types.insert(types.end() - 1, "PrefilteredShadows");
  graph::Pipeline pipeline = testing::rows(types);
  pipeline.passes.back().params = {
      {"shadows", shadows}, {"kernel", std::int64_t{23}}, {"search", std::int64_t{11}}};
  for (graph::PassRow& row : pipeline.passes) {
    if (row.type == "ShadowLayers") row.params["layers"] = std::int64_t{32};
    if (row.type == "Penumbra") row.params["search"] = std::int64_t{11};
    if (row.type == "ShadowBlur") row.params["kernel"] = std::int64_t{23};
  }
  return pipeline;
}

class SoftShadows : public ::testing::TestWithParam<std::string> {
 protected:
  void TearDown() override { testing::expectNoDebugMessages(); }
};
INSTANTIATE_TEST_SUITE_P(By, SoftShadows, ::testing::Values("pcss", "prefiltered", "layered"),
                         [](const auto& parameter) { return parameter.param; });

TEST_P(SoftShadows, ArePenumbraeOfTheRightWidth) {
  constexpr uvec2 kPicture{513, 129};
  constexpr float kLampX = -1.f, kEdgeX = 0.f, kHalfWay = 0.5f * kWall;
  for (const float radius : {0.2f, 0.4f, 0.8f}) {
    SCOPED_TRACE(radius);
    scene::Scene scene = testing::emptyScene();
    testing::addWall(scene, kWall);
    testing::addBox(scene, {kEdgeX - 20.f, 0, -kHalfWay}, {40, 40, 1e-3f});
    addLamp(scene, {kLampX, 0.5f, 0}, {kLampX, 0.5f, -kWall});
    scene.lights.back().radius = radius;
    updateTransforms(scene);
    const auto rowOf = [&](const std::string& shadows) {
      graph::Pipeline pipeline = softRows(shadows);
      for (graph::PassRow& row : pipeline.passes)
        if (row.type == "ShadowMaps") row.params["localSize"] = std::int64_t{2048};
      return testing::asFloatRgb(
          testing::valueOf(scene, pipeline, kPicture, "TiledLighting.color"));
    };
    const Image lit = rowOf("none"), soft = rowOf(GetParam());
    const float aspect = static_cast<float>(kPicture.x) / static_cast<float>(kPicture.y);
    const float width = 2.f * kWall * std::tan(0.5f * scene.cameras[0].fovY) * aspect;  // m
    const float middle = kEdgeX + (kEdgeX - kLampX);  // as far behind the edge as before it
    double worst = 0;
    int within = 0;
    for (int x = kPicture.x / 2 + 2; x < static_cast<int>(kPicture.x); ++x) {
      const float at = width * ((static_cast<float>(x) + 0.5f) / kPicture.x - 0.5f);
      const double share = visibleShareOfDisc((at - middle) / radius);
      const int y = kPicture.y / 2;
      const double found = soft.pixel<float>(x, y)[1] / lit.pixel<float>(x, y)[1];
      worst = std::max(worst, std::abs(found - share));
      within += std::abs(at - middle) < radius;
    }
    EXPECT_GT(within, 3);
    EXPECT_LT(worst, 0.12);
  }
}

// However many lamps overlap, each has the shadow that it has alone: light adds up.
TEST_P(SoftShadows, OfLampsTogetherAreThoseOfEachAlone) {
  constexpr uvec2 kPicture{96, 64};
  constexpr int kLamps = 32;
  scene::Scene scene = testing::emptyScene();
  testing::addWall(scene, kWall);
  testing::addBox(scene, {0, 0, -4}, vec3(0.7f));
  for (int i = 0; i < kLamps; ++i) {
    const float turn = 2.f * kPi * static_cast<float>(i) / kLamps;
    addLamp(scene, {1.5f * std::cos(turn), std::sin(turn), -1.f}, {0, 0, -kWall});
    scene.lights.back().radius = 0.1f;
    scene.lights.back().intensity = 2.f;
  }
  updateTransforms(scene);
  const auto picture = [&] {
    return testing::asFloatRgb(
        testing::valueOf(scene, softRows(GetParam()), kPicture, "TiledLighting.color"));
  };
  const Image together = picture();
  std::vector<double> sum(together.as<float>().size());
  for (int i = 0; i < kLamps; ++i) {
    for (int j = 0; j < kLamps; ++j) scene.lights[static_cast<std::size_t>(j)].on = i == j;
    const Image alone = picture();
    for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += alone.as<float>()[k];
  }
  double brightest = 0, worst = 0;
  for (std::size_t k = 0; k < sum.size(); ++k) {
    brightest = std::max(brightest, sum[k]);
    worst = std::max(worst, std::abs(sum[k] - together.as<float>()[k]));
  }
  EXPECT_GT(brightest, 0.5);
  EXPECT_LT(worst, 2. / 255. * brightest);
}

// Two spots side by side on a wall, each with a cube in its light: one layer is enough for both
// while what they reach is far enough apart, and each has the shadow that it has alone.
TEST(LayersOfTiles, AreSharedByLampsThatAreApart) {
  constexpr uvec2 kPicture{384, 96};
  for (const float side : {5.f, 0.6f}) {
    SCOPED_TRACE(side);
    scene::Scene scene = testing::emptyScene();
    testing::addWall(scene, kWall);
    for (const float x : {-side, side}) {
      testing::addBox(scene, {x, 0, -5}, vec3(0.3f));
      addLamp(scene, {x, 0.2f, -3}, {x, 0, -kWall});
      scene.lights.back().outerCone = 0.3f;
      scene.lights.back().innerCone = 0.25f;
      scene.lights.back().radius = 0.15f;
    }
    updateTransforms(scene);
    const auto picture = [&](std::int64_t layers) {
      graph::Pipeline pipeline = softRows("layered");
      for (graph::PassRow& row : pipeline.passes)
        if (row.type == "ShadowLayers") row.params["layers"] = layers;
      return testing::asFloatRgb(
          testing::valueOf(scene, pipeline, kPicture, "TiledLighting.color"));
    };
    // One layer is as good as many, or the second lamp goes without and has a hard shadow.
    const Image one = picture(1), many = picture(32);
    EXPECT_EQ(std::ranges::equal(one.bytes(), many.bytes()), side > 1.f);
    Image sum = many;
    std::ranges::fill(sum.as<float>(), 0.f);
    for (const bool first : {true, false}) {
      scene.lights[0].on = first, scene.lights[1].on = !first;
      const Image alone = picture(1);
      for (std::size_t i = 0; i < sum.as<float>().size(); ++i)
        sum.as<float>()[i] += alone.as<float>()[i];
    }
    for (std::size_t i = 0; i < sum.as<float>().size(); ++i)
      ASSERT_NEAR(sum.as<float>()[i], many.as<float>()[i], 2e-2f * many.as<float>()[i] + 1e-3f);
  }
  testing::expectNoDebugMessages();
}

}  // namespace
}  // namespace lucerna
