#include <gtest/gtest.h>

#include <algorithm>

#include "support/testing.hpp"

namespace lucerna {
namespace {

constexpr uvec2 kSize{96, 64};

class ScreenSpaceAo : public ::testing::TestWithParam<std::string> {
 protected:
  void TearDown() override { testing::expectNoDebugMessages(); }

  static graph::Pipeline rows(const graph::ParamValues& params) {
    graph::Pipeline pipeline = testing::rows({"Cull", "GBuffer", "ScreenSpaceAo", "TiledLighting"});
    pipeline.passes[2].params = params;
    return pipeline;
  }
  Image visibility(const scene::Scene& scene, graph::ParamValues params = {}) const {
    params["method"] = GetParam();
    return testing::valueOf(scene, rows(params), kSize, "ScreenSpaceAo.ambientVisibility");
  }
  static int at(const Image& image, int x, int y) { return *image.pixel<std::uint8_t>(x, y); }
};
INSTANTIATE_TEST_SUITE_P(By, ScreenSpaceAo, ::testing::Values("horizon", "hemisphere", "gaussian"),
                         [](const auto& parameter) { return parameter.param; });

// A plane hides nothing of itself, however it is tilted and however near or far.
TEST_P(ScreenSpaceAo, APlaneIsFree) {
  for (const float degrees : {0.f, 30.f, 60.f, 80.f, 88.f})
    for (const float distance : {1.f, 10.f, 300.f}) {
      scene::Scene scene = testing::emptyScene();
      testing::addWall(scene, distance);
      scene::Node& node = scene.nodes[scene.objects.back().node];
      node.scale = vec3(4.f * distance, 4.f * distance, 0.01f * distance);
      node.rotation = glm::angleAxis(glm::radians(degrees), vec3(1, 0, 0));
      updateTransforms(scene);
      const Image image =
          visibility(scene, {{"blur", "none"}, {"radius", 0.2 * static_cast<double>(distance)}});
      int lowest = 255;
      for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x) lowest = std::min(lowest, at(image, x, y));
      EXPECT_GE(lowest, 254) << degrees << " degrees, " << distance << " m";
    }
}

// Two walls that meet: dark where they do, free a radius away.
TEST_P(ScreenSpaceAo, ACornerIsDark) {
  scene::Scene scene = testing::emptyScene();
  testing::addWall(scene, 10.f);
  testing::addWall(scene, 10.f);
  scene::Node& floor = scene.nodes[scene.objects.back().node];
  floor.translation = {0, -2, -5};
  floor.scale = {40, 0.001f, 9.9f};
  updateTransforms(scene);
  const Image image = visibility(scene, {{"radius", 1.0}});
  int darkest = 255;
  for (int y = 0; y < image.height(); ++y) darkest = std::min(darkest, at(image, 48, y));
  // The horizon sees about half the sky; points behind the floor, steeply seen, count as another
  // thing (the page's known artefacts).
  EXPECT_LT(darkest, GetParam() == "horizon" ? 160 : 225);
  EXPECT_GT(darkest, 60);
  EXPECT_EQ(at(image, 48, 20), 255) << "the wall above";
}

// What stands farther in front than the radius throws nothing on what is behind it.
TEST_P(ScreenSpaceAo, ACardInFrontOfAWallHasNoAura) {
  scene::Scene scene = testing::emptyScene();
  testing::addWall(scene, 10.f);
  testing::addWall(scene, 5.f);
  scene.nodes[scene.objects.back().node].scale = vec3(1.f, 1.f, 0.001f);
  updateTransforms(scene);
  const Image image = visibility(scene, {{"radius", 1.0}, {"blur", "none"}});
  int lowest = 255;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) lowest = std::min(lowest, at(image, x, y));
  EXPECT_GE(lowest, 254);
}

// It dims the ambient light and nothing else.
TEST_P(ScreenSpaceAo, DimsAmbientLightAlone) {
  for (const bool ambient : {true, false}) {
    scene::Scene scene = testing::sampleScene();
    scene.ambient = vec3(ambient ? 1.f : 0.f);
    for (scene::Light& light : scene.lights) light.ambientIntensity = 0.f;
    const Image with = testing::valueOf(scene, rows({{"radius", 2.0}, {"method", GetParam()}}),
                                        kSize, "TiledLighting.color");
    const Image without = testing::valueOf(
        scene, testing::rows({"Cull", "GBuffer", "TiledLighting"}), kSize, "TiledLighting.color");
    EXPECT_EQ(std::ranges::equal(with.bytes(), without.bytes()), !ambient);
  }
}

// System A's way: all light, and pixels in which nothing was drawn as they were.
TEST_P(ScreenSpaceAo, MultipliesThePictureIfTold) {
  const scene::Scene scene = testing::sampleScene();
  graph::Pipeline pipeline =
      testing::rows({"Cull", "GBuffer", "TiledLighting", "Background", "ScreenSpaceAo"});
  pipeline.passes.back().params = {{"apply", "multiply"}, {"radius", 2.0}, {"method", GetParam()}};
  testing::SceneRenderer renderer(scene);
  const auto output = renderer.render(
      pipeline, kSize,
      {"Background.color", "ScreenSpaceAo.ambientVisibility", "ScreenSpaceAo.color"});
  ASSERT_TRUE(output) << output.error().message;
  const Image& before = output->kept.at("Background.color");
  const Image& share = output->kept.at("ScreenSpaceAo.ambientVisibility");
  const Image& after = output->kept.at("ScreenSpaceAo.color");
  int darker = 0;
  for (int y = 0; y < after.height(); ++y)
    for (int x = 0; x < after.width(); ++x)
      for (int c = 0; c < 4; ++c) {
        const float was = floatFromHalf(before.pixel<std::uint16_t>(x, y)[c]);
        const float is = floatFromHalf(after.pixel<std::uint16_t>(x, y)[c]);
        const float factor = c == 3 ? 1.f : static_cast<float>(at(share, x, y)) / 255.f;
        EXPECT_NEAR(is, was * factor, 1e-3f * was) << x << ", " << y << ", component " << c;
        darker += is < was;
      }
  EXPECT_GT(darker, 1000);
}

// Nothing drawn, nothing hidden.
TEST_P(ScreenSpaceAo, EmptyPixelsAreFree) {
  scene::Scene scene = testing::emptyScene();
  testing::addWall(scene, 5.f);
  scene.nodes[scene.objects.back().node].scale = vec3(1.f, 1.f, 0.001f);
  updateTransforms(scene);
  const Image image = visibility(scene);
  EXPECT_EQ(at(image, 0, 0), 255);
  EXPECT_EQ(at(image, 95, 63), 255);
}

}  // namespace
}  // namespace lucerna
