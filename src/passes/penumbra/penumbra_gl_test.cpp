// What layered shadows are without penumbrae; their widths: tests/e2e/penumbra_widths_test.cpp.
#include <gtest/gtest.h>

#include <algorithm>

#include "support/testing.hpp"

namespace lucerna {
namespace {

constexpr uvec2 kSize{96, 64};

// A cube in the light of a spot lamp on a wall.
scene::Scene cubeScene(float radius) {
  scene::Scene scene = testing::emptyScene();
  testing::addWall(scene, 6.f);
  testing::addBox(scene, {0, 0, -4}, vec3(0.8f));
  scene::Light light;
  light.kind = scene::LightKind::Spot;
  light.intensity = 50.f;
  light.radius = radius;
  testing::addLight(scene, light, {0.8f, 0.6f, 0}, {0, 0, -6});
  updateTransforms(scene);
  return scene;
}

Image picture(const scene::Scene& scene, const std::string& shadows, bool penumbrae = true) {
  graph::Pipeline pipeline =
      testing::rows({"Cull", "GBuffer", "ShadowMaps", "TileLights", "ShadowLayers", "ShadowMask",
                     "Penumbra", "ShadowBlur", "TiledLighting"});
  if (shadows == "hard")
    pipeline.passes.erase(pipeline.passes.begin() + 4, pipeline.passes.end() - 1);
  pipeline.passes.back().params["shadows"] = shadows;
  for (graph::PassRow& row : pipeline.passes)
    if (row.type == "Penumbra") row.enabled = penumbrae;
  return testing::asFloatRgb(testing::valueOf(scene, pipeline, kSize, "TiledLighting.color"));
}

TEST(Penumbra, WithoutItLampsHaveHardShadows) {
  const scene::Scene scene = cubeScene(0.3f);
  const Image hard = picture(scene, "hard");
  const Image without = picture(scene, "layered", false), with = picture(scene, "layered");
  EXPECT_TRUE(std::ranges::equal(without.bytes(), hard.bytes()));
  EXPECT_FALSE(std::ranges::equal(with.bytes(), hard.bytes()));
  testing::expectNoDebugMessages();
}

// But for pixels within two of the shadow's edge: at half the size a texel stands for four and
// serves their neighbours.
TEST(Penumbra, OfALampWithoutSizeIsNone) {
  const scene::Scene scene = cubeScene(0.f);
  const Image hard = picture(scene, "hard"), layered = picture(scene, "layered");
  int different = 0, edges = 0;
  for (int y = 2; y + 2 < hard.height(); ++y)
    for (int x = 2; x + 2 < hard.width(); ++x) {
      const float value = hard.pixel<float>(x, y)[1];
      bool edge = false;
      for (int dy = -2; dy <= 2; ++dy)
        for (int dx = -2; dx <= 2; ++dx)
          edge = edge || std::abs(hard.pixel<float>(x + dx, y + dy)[1] - value) > 0.2f * value;
      edges += edge;
      different += !edge && std::abs(layered.pixel<float>(x, y)[1] - value) > 0.02f * value;
    }
  EXPECT_GT(edges, 20);
  EXPECT_EQ(different, 0);
  testing::expectNoDebugMessages();
}

}  // namespace
}  // namespace lucerna
