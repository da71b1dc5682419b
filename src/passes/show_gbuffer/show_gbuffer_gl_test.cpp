#include <gtest/gtest.h>

#include <array>
#include <cstdlib>

#include "support/testing.hpp"

namespace lucerna {
namespace {

std::array<int, 3> shown(const scene::Scene& scene, const std::string& component) {
  graph::Pipeline pipeline = testing::rows({"Cull", "GBuffer", "ShowGBuffer"});
  pipeline.passes.back().params = {{"component", component}};
  const Image picture = testing::pictureOf(scene, pipeline, {9, 9});
  const std::uint8_t* p = picture.pixel<std::uint8_t>(4, 4);
  return {p[0], p[1], p[2]};
}

TEST(ShowGBuffer, ShowsEachComponentOfAKnownWall) {
  scene::Scene scene = testing::emptyScene();
  scene::Material& wall = testing::addWall(scene, 10.f);
  wall.model = scene::MaterialModel::Phong;
  wall.albedo = {1.f, 0.5f, 0.f, 1.f};
  wall.specular = {0.f, 0.25f, 1.f};
  wall.shininess = 100.f;
  wall.emissive = {0.5f, 0.f, 1.f};
  using Rgb = std::array<int, 3>;
  const auto near = [](Rgb a, Rgb b) {
    return std::abs(a[0] - b[0]) <= 1 && std::abs(a[1] - b[1]) <= 1 && std::abs(a[2] - b[2]) <= 1;
  };
  EXPECT_NEAR(shown(scene, "depth")[0], 128, 1) << "10 m at a scale of 10 m";
  EXPECT_TRUE(near(shown(scene, "albedo"), {255, 188, 0}));
  EXPECT_TRUE(near(shown(scene, "specular"), {0, 137, 255}));
  EXPECT_EQ(shown(scene, "occlusion"), (Rgb{255, 255, 255}));
  EXPECT_EQ(shown(scene, "shininess"), (Rgb{100, 100, 100}));
  EXPECT_EQ(shown(scene, "metallic"), (Rgb{0, 0, 0}));
  EXPECT_NEAR(shown(scene, "emissive")[0], 188, 1);
  EXPECT_EQ(shown(scene, "normal")[2], 255) << "it faces the eye";
  testing::expectNoDebugMessages();
}

}  // namespace
}  // namespace lucerna
