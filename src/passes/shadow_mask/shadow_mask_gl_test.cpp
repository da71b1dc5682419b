// Bits of the mask against each light's own shadow.
#include <gtest/gtest.h>

#include <algorithm>

#include "support/testing.hpp"

namespace lucerna {
namespace {

constexpr uvec2 kSize{80, 60};

// Lamps beside each other that all light a wall, and a cube before it.
scene::Scene lampScene(int lamps) {
  scene::Scene scene = testing::emptyScene();
  testing::addWall(scene, 6.f);
  testing::addBox(scene, {0, 0, -4.5f}, vec3(0.6f));
  for (int i = 0; i < lamps; ++i) {
    scene::Light light;
    light.kind = i % 2 == 0 ? scene::LightKind::Spot : scene::LightKind::Point;
    light.intensity = 50.f;
    light.name = "lamp" + std::to_string(i);
    const float x = 4.f * ((static_cast<float>(i) + 0.5f) / static_cast<float>(lamps) - 0.5f);
    testing::addLight(scene, light, {x, 0.7f, -0.5f}, {0, 0, -6});
  }
  updateTransforms(scene);
  return scene;
}

Image valueOf(const scene::Scene& scene, const graph::Pipeline& pipeline,
              const std::string& value) {
  return testing::valueOf(scene, pipeline, kSize, value);
}

graph::Pipeline maskRows() {
  return testing::rows({"Cull", "GBuffer", "ShadowMaps", "TileLights", "ShadowLayers", "ShadowMask",
                        "TiledLighting"});
}

TEST(ShadowMask, HasEachLightsShadowInItsLayer) {
  for (const int lamps : {1, 7, 32}) {
    SCOPED_TRACE(lamps);
    scene::Scene scene = lampScene(lamps);
    graph::Pipeline pipeline = maskRows();
    pipeline.passes[4].params["layers"] = std::int64_t{32};
    const Image mask = valueOf(scene, pipeline, "ShadowMask.shadowMask");
    std::uint32_t together = 0;
    for (int i = 0; i < lamps; i += 5) {
      scene::Scene alone = scene;
      for (scene::Light& light : alone.lights) light.on = light.name == "lamp" + std::to_string(i);
      graph::Pipeline lit = testing::rows({"Cull", "GBuffer", "ShadowMaps", "TiledLighting"});
      lit.passes[3].params = {{"shadows", std::string("hard")},
                              {"comparison", std::string("plane")}};
      const Image hard = testing::asFloatRgb(valueOf(alone, lit, "TiledLighting.color"));
      lit.passes[3].params = {{"shadows", std::string("none")}};
      lit.passes.erase(lit.passes.begin() + 2);
      const Image open = testing::asFloatRgb(valueOf(alone, lit, "TiledLighting.color"));
      int wrong = 0, blocked = 0;
      // All lamps overlap, so that the order of layers is that of lights.
      for (int y = 0; y < hard.height(); ++y)
        for (int x = 0; x < hard.width(); ++x) {
          if (open.pixel<float>(x, y)[1] < 1e-3f) continue;
          const bool shadow = hard.pixel<float>(x, y)[1] < 0.5f * open.pixel<float>(x, y)[1];
          const std::uint32_t bits = *mask.pixel<std::uint32_t>(x, y);
          wrong += shadow != ((bits >> i & 1u) != 0);
          blocked += shadow;
          together |= bits;
        }
      EXPECT_EQ(wrong, 0) << "lamp " << i;
      EXPECT_GT(blocked, 20) << "lamp " << i;
    }
    EXPECT_EQ(together, lamps == 32 ? 0xffffffffu : (1u << lamps) - 1u);
  }
  testing::expectNoDebugMessages();
}

// As published, four layers go through sixteenths in a byte: from nine on a pattern comes back as
// the one before.
TEST(ShadowMask, AsPublishedHasWrongPatternsOfFourLayers) {
  scene::Scene scene = lampScene(7);
  graph::Pipeline pipeline = maskRows();
  const Image mended = valueOf(scene, pipeline, "ShadowMask.shadowMask");
  pipeline.passes[5].params["variant"] = std::string("published");
  const Image published = valueOf(scene, pipeline, "ShadowMask.shadowMask");
  int wrong = 0;
  for (int y = 0; y < mended.height(); ++y)
    for (int x = 0; x < mended.width(); ++x) {
      const std::uint32_t bits = *mended.pixel<std::uint32_t>(x, y);
      std::uint32_t expected = 0;
      for (int first = 0; first < 32; first += 4) {
        const std::uint32_t four = bits >> first & 15u;
        expected |= (four < 9 ? four : four - 1) << first;
      }
      ASSERT_EQ(*published.pixel<std::uint32_t>(x, y), expected);
      wrong += expected != bits;
    }
  EXPECT_GT(wrong, 20);
  testing::expectNoDebugMessages();
}

}  // namespace
}  // namespace lucerna
