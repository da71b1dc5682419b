// Lights of tiles: none that reaches a pixel is missing, and few that do not are there.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstring>

#include "core/random.hpp"
#include "passes/tile_lights/tile_lights.hpp"
#include "scene/load.hpp"
#include "support/testing.hpp"

namespace lucerna {
namespace {

constexpr uvec2 kSize{75, 50};  // the last tiles are cut off

// Lamps of all kinds all over the scene's box.
void addLamps(scene::Scene& scene, int count) {
  const Aabb box = scene.boundsW();
  Random random(3);
  const auto place = [&] {
    const vec3 share(random.uniform(), random.uniform(), random.uniform());
    return box.min + share * (box.max - box.min);
  };
  for (int i = 0; i < count; ++i) {
    scene::Light light;
    light.kind = i % 3 == 0 ? scene::LightKind::Point : scene::LightKind::Spot;
    light.intensity = random.uniform(1.f, 20.f);
    light.range = random.uniform(0.5f, 5.f);
    light.outerCone = random.uniform(0.1f, 1.8f);  // rad, beyond a right angle, too
    light.innerCone = 0.5f * light.outerCone;
    testing::addLight(scene, light, place(), place());
  }
}

std::vector<std::string> rows(bool tiled) {
  std::vector<std::string> types{"Cull", "GBuffer", "TileLights", "TiledLighting", "Background"};
  if (!tiled) std::erase(types, "TileLights");
  return types;
}

class TileLights : public ::testing::Test {
 protected:
  void TearDown() override { testing::expectNoDebugMessages(); }
};

void expectSamePicture(const scene::Scene& scene, const scene::View& view) {
  testing::SceneRenderer renderer(scene);
  const auto picture = [&](bool tiled) {
    auto output = renderer.render(testing::rows(rows(tiled)), view, kSize, {"TiledLighting.color"});
    CHECK(static_cast<bool>(output), "{}", output.error().message);
    return output->kept.at("TiledLighting.color");
  };
  const Image with = picture(true), without = picture(false);
  EXPECT_TRUE(std::ranges::equal(with.bytes(), without.bytes()));
  const auto values = testing::asFloatRgb(with);
  EXPECT_GT(std::ranges::max(values.as<float>()), 0.1f);
}

TEST_F(TileLights, LeaveOutNoLightThatReachesAPixel) {
  for (const int count : {1, 31, 64, 200}) {
    SCOPED_TRACE(count);
    scene::Scene scene = testing::sampleScene();
    addLamps(scene, count);
    updateTransforms(scene);
    for (const scene::Camera& camera : scene.cameras) {
      const scene::View view = viewOf(scene, camera, 1.5f);
      expectSamePicture(scene, view);
      expectSamePicture(scene, eyeView(view, 0.3f, 2.f));
      scene::Camera parallel = camera;
      parallel.orthographic = true;
      expectSamePicture(scene, viewOf(scene, parallel, 1.5f));
    }
  }
}

// Bits that are set in all tiles.
std::size_t bitsIn(const scene::Scene& scene, bool normals = true) {
  testing::SceneRenderer renderer(scene);
  auto output = renderer.render(testing::rows({"Cull", "GBuffer", "TiledLighting"}), kSize,
                                {"GBuffer.depth", "GBuffer.normal"});
  CHECK(static_cast<bool>(output), "{}", output.error().message);
  const gpu::Texture depth =
      testing::uploaded(output->kept.at("GBuffer.depth"), gpu::Format::Depth32F);
  const gpu::Texture normal =
      testing::uploaded(output->kept.at("GBuffer.normal"), gpu::Format::Rg16Unorm);
  render::TileLights tileLights;
  passes::TileLights::Ports ports;
  ports.view.bind(&renderer.view);
  ports.lights.bind(&renderer.lights);
  ports.depth.bind(&depth);
  if (normals) ports.normal.bind(&normal);
  ports.tileLights.bind(&tileLights);
  graph::PassContext context{.device = testing::device()};
  passes::TileLights(testing::device()).execute(context, {}, ports);
  const std::vector<std::byte> bytes = testing::device().download(tileLights.block);
  std::vector<std::uint32_t> words(bytes.size() / 4);
  std::memcpy(words.data(), bytes.data(), bytes.size());
  EXPECT_EQ(words[0], 5u) << "tiles across";
  std::size_t bits = 0;
  for (std::size_t i = 4; i < words.size(); ++i)
    bits += static_cast<std::size_t>(std::popcount(words[i]));
  return bits;
}

// A wall before the camera, and lamps along it that each reach a part of it.
TEST_F(TileLights, HoldFewLightsThatDoNotReachThem) {
  scene::Scene scene = testing::emptyScene();
  testing::addWall(scene, 4.f);
  for (int i = 0; i < 100; ++i) {
    scene::Light light;
    light.kind = scene::LightKind::Point;
    light.range = 0.3f;
    const int column = i % 10, row = i / 10;
    const vec3 at(0.4f * static_cast<float>(column) - 2.f, 0.3f * static_cast<float>(row) - 1.5f,
                  -3.9f);
    testing::addLight(scene, light, at, at - vec3(0, 0, 1));
  }
  updateTransforms(scene);
  EXPECT_GT(bitsIn(scene), 20u);
  EXPECT_LT(bitsIn(scene), 15u * 20u) << "of 100 lamps, in 20 tiles";
}

// Of a lamp behind the wall, and of one that shines away from it, no tile has a bit.
TEST_F(TileLights, HoldNoLightThatReachesNothingInSight) {
  scene::Scene scene = testing::emptyScene();
  testing::addWall(scene, 4.f);
  scene::Light light;
  light.kind = scene::LightKind::Spot;
  light.range = 2.f;
  testing::addLight(scene, light, {0, 0, -3}, {0, 0, 5});
  light.kind = scene::LightKind::Point;
  testing::addLight(scene, light, {0, 0, -7}, {0, 0, -8});
  updateTransforms(scene);
  EXPECT_EQ(bitsIn(scene), 0u);
  light.range = 5.f;
  testing::addLight(scene, light, {0, 0, -1}, {0, 0, -8});
  updateTransforms(scene);
  EXPECT_GT(bitsIn(scene), 0u);
}

// A lamp behind the wall that would reach it: only its normals tell.
TEST_F(TileLights, HoldNoLightThatAllSurfacesFaceAwayFrom) {
  scene::Scene scene = testing::emptyScene();
  testing::addWall(scene, 4.f);
  scene::Light light;
  light.kind = scene::LightKind::Point;
  light.range = 5.f;
  testing::addLight(scene, light, {0, 0, -5}, {0, 0, -8});
  updateTransforms(scene);
  EXPECT_EQ(bitsIn(scene), 0u);
  EXPECT_GT(bitsIn(scene, false), 0u);
}

}  // namespace
}  // namespace lucerna
