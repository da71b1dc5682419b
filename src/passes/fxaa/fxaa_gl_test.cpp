#include <gtest/gtest.h>

#include <algorithm>

#include "image/metrics.hpp"
#include "support/testing.hpp"

namespace lucerna {
namespace {

// A tilted white card before black.
scene::Scene card() {
  scene::Scene scene = testing::emptyScene();
  scene::Material& wall = testing::addWall(scene, 3.f);
  wall.model = scene::MaterialModel::Unlit;
  scene::Node& node = scene.nodes[scene.objects.back().node];
  node.scale = vec3(2.f, 2.f, 0.01f);
  node.rotation = glm::angleAxis(0.1f, vec3(0, 0, 1));
  updateTransforms(scene);
  return scene;
}

graph::Pipeline rows(const graph::ParamValues& params) {
  graph::Pipeline pipeline = testing::rows({"Cull", "Forward", "Background", "ToneMap", "Fxaa"});
  pipeline.passes[3].params = {{"operator", std::string("linear")}};
  pipeline.passes[4].params = params;
  return pipeline;
}

TEST(Fxaa, LeavesWhatIsEvenAsItIs) {
  const graph::Pipeline pipeline = rows({});
  const Image before = testing::valueOf(card(), pipeline, {64, 64}, "ToneMap.color");
  const Image after = testing::valueOf(card(), pipeline, {64, 64}, "Fxaa.color");
  int changed = 0;
  for (int y = 1; y < 63; ++y)
    for (int x = 1; x < 63; ++x) {
      const int here = before.pixel<std::uint8_t>(x, y)[0];
      bool even = true;
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx)
          even = even && before.pixel<std::uint8_t>(x + dx, y + dy)[0] == here;
      const int now = after.pixel<std::uint8_t>(x, y)[0];
      EXPECT_TRUE(!even || now == here) << x << ", " << y;
      changed += now != here;
    }
  EXPECT_GT(changed, 50);
  testing::expectNoDebugMessages();
}

// The stairs come nearer to the line that they stand for: the same card drawn four times as large,
// and averaged.
TEST(Fxaa, BringsStairsNearerToTheLine) {
  constexpr unsigned kSize = 96, kFactor = 8;
  const Image large =
      testing::valueOf(card(), rows({}), {kFactor * kSize, kFactor * kSize}, "ToneMap.color");
  Image truth(kSize, kSize, 3, ComponentType::F32);
  for (unsigned y = 0; y < kFactor * kSize; ++y)
    for (unsigned x = 0; x < kFactor * kSize; ++x)
      for (int c = 0; c < 3; ++c)
        truth.pixel<float>(static_cast<int>(x / kFactor), static_cast<int>(y / kFactor))[c] +=
            static_cast<float>(
                large.pixel<std::uint8_t>(static_cast<int>(x), static_cast<int>(y))[c]) /
            (255.f * kFactor * kFactor);
  const auto psnr = [&](const char* value) {
    const Image image = testing::valueOf(card(), rows({}), {kSize, kSize}, value);
    return pixelMetrics(truth, converted(image, ComponentType::F32, 3)).psnr;
  };
  EXPECT_GT(psnr("Fxaa.color"), psnr("ToneMap.color") + 4.);
}

}  // namespace
}  // namespace lucerna
