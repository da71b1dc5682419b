#include <gtest/gtest.h>

#include <cmath>

#include "support/testing.hpp"

namespace lucerna {
namespace {

// The encoded value of a background of the given radiance.
std::array<int, 3> shown(vec3 radiance, const std::string& curve, double exposure = 0,
                         float sceneExposure = 0) {
  scene::Scene scene = testing::emptyScene();
  scene.background.color = radiance;
  scene.exposure = sceneExposure;
  graph::Pipeline pipeline = testing::rows({"Cull", "Forward", "Background", "ToneMap"});
  pipeline.passes.back().params = {{"operator", curve}, {"exposure", exposure}};
  const Image picture = testing::pictureOf(scene, pipeline, {4, 4});
  const std::uint8_t* p = picture.pixel<std::uint8_t>(2, 2);
  return {p[0], p[1], p[2]};
}

TEST(ToneMap, LinearEncodesAsSrgbAndClips) {
  const auto values = shown({0.5f, 0.0015f, 7.f}, "linear");
  EXPECT_NEAR(values[0], srgbFromLinear(0.5f) * 255.f, 1.f);
  EXPECT_NEAR(values[1], 0.0015f * 12.92f * 255.f, 1.f);
  EXPECT_EQ(values[2], 255);
  testing::expectNoDebugMessages();
}

TEST(ToneMap, NoneLeavesTheValuesAsTheyAre) {
  EXPECT_NEAR(shown(vec3(0.5f), "none")[0], 128, 1);
}

TEST(ToneMap, OneStopDoublesWhetherOfTheSceneOrTheParameter) {
  const auto expected = shown(vec3(0.4f), "linear");
  EXPECT_EQ(shown(vec3(0.1f), "linear", 2), expected);
  EXPECT_EQ(shown(vec3(0.1f), "linear", 0, 2.f), expected);
  EXPECT_EQ(shown(vec3(0.1f), "linear", 3, -1.f), expected);
}

TEST(ToneMap, CurvesRiseFromBlackTowardsWhite) {
  for (const char* curve : {"filmic", "reinhard"}) {
    EXPECT_EQ(shown(vec3(0.f), curve)[0], 0) << curve;
    int before = -1;
    for (const float radiance : {0.01f, 0.05f, 0.2f, 0.8f, 2.f, 6.f}) {
      const int value = shown(vec3(radiance), curve)[0];
      EXPECT_GT(value, before) << curve << " at " << radiance;
      before = value;
    }
    EXPECT_GE(shown(vec3(60000.f), curve, 10)[0], 254) << curve;
  }
}

}  // namespace
}  // namespace lucerna
