// Forward is the baseline of the deferred chain: both must show the same picture.
#include <gtest/gtest.h>

#include <cstdio>

#include "image/metrics.hpp"
#include "scene/load.hpp"
#include "support/testing.hpp"

namespace lucerna {
namespace {

// The same surfaces, lights and formulas by two ways: they differ by the G-buffer's rounding only.
double deferredAgainstForward(const scene::Scene& scene, uvec2 size) {
  const auto picture = [&](std::vector<std::string> types) {
    std::erase(types, "Transparency");
    return testing::asFloatRgb(testing::pictureOf(scene, testing::rows(types), size));
  };
  return pixelMetrics(picture(testing::kForwardRows), picture(testing::kDeferredRows)).psnr;
}

TEST(DeferredAgainstForward, AgreeOnTheSampleScene) {
  const double psnr = deferredAgainstForward(testing::sampleScene(), {320, 180});
  std::printf("deferred against forward, sample scene: %.1f dB\n", psnr);
  EXPECT_GE(psnr, 45.);
  testing::expectNoDebugMessages();
}

TEST(DeferredAgainstForward, AgreeOnTheAtrium) {
  const auto scene = scene::loadScene("builtin:atrium");
  ASSERT_TRUE(scene) << scene.error().message;
  const double psnr = deferredAgainstForward(*scene, {640, 360});
  std::printf("deferred against forward, atrium: %.1f dB\n", psnr);
  EXPECT_GE(psnr, 45.);
  testing::expectNoDebugMessages();
}

}  // namespace
}  // namespace lucerna
