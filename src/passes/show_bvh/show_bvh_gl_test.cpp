#include "passes/show_bvh/show_bvh.hpp"

#include <gtest/gtest.h>

#include "support/testing.hpp"

namespace lucerna {
namespace {

constexpr uvec2 kSize{64, 64};
constexpr vec3 kColor(0.1f, 0.5f, 0.3f);

// The brightest pixel of a dark scene with one box: a line's. `order` is that of the last two rows.
std::array<int, 3> lineShown(const std::vector<std::string>& order, float sceneExposure) {
  scene::Scene scene = testing::emptyScene();
  testing::addWall(scene, 20.f);
  scene.exposure = sceneExposure;
  std::vector<std::string> types{"Cull", "Forward", "Background"};
  types.insert(types.end(), order.begin(), order.end());
  graph::Pipeline pipeline = testing::rows(types);
  for (graph::PassRow& row : pipeline.passes) {
    if (row.type == "ToneMap") row.params["operator"] = std::string("linear");
    if (row.type == "ShowBvh") row.params["lineColor"] = std::vector<double>{0.1, 0.5, 0.3};
  }
  const Image picture = testing::pictureOf(scene, pipeline, kSize);
  std::array<int, 3> brightest{};
  for (int y = 0; y < picture.height(); ++y)
    for (int x = 0; x < picture.width(); ++x) {
      const std::uint8_t* p = picture.pixel<std::uint8_t>(x, y);
      if (p[1] > brightest[1]) brightest = {p[0], p[1], p[2]};
    }
  return brightest;
}

TEST(ShowBvh, LinesShowInTheirColorAtAnyExposureBeforeAndAfterToneMap) {
  for (const float exposure : {-6.f, 0.f, 6.f})
    for (const auto& order : {std::vector<std::string>{"ShowBvh", "ToneMap"},
                              std::vector<std::string>{"ToneMap", "ShowBvh"}}) {
      const auto shown = lineShown(order, exposure);
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(shown[c], 255.f * srgbFromLinear(kColor[c]), 1.f)
            << order.front() << " first, " << exposure << " EV, channel " << c;
    }
  testing::expectNoDebugMessages();
}

}  // namespace
}  // namespace lucerna
