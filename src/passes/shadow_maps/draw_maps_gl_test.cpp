// Maps that are drawn together are those drawn alone, to the last bit.
#include "passes/shadow_maps/draw_maps.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/testing.hpp"

namespace lucerna {
namespace {

using Map = render::ShadowMaps::Map;

constexpr int kSide = 128, kLayers = 3;

gpu::Texture layers() {
  gpu::Texture texture = testing::device().createTexture({.kind = gpu::TextureKind::Array2D,
                                                          .format = gpu::Format::Depth32F,
                                                          .width = kSide,
                                                          .height = kSide,
                                                          .layers = kLayers},
                                                         "maps");
  testing::device().clear(texture, vec4(0.25f));  // what nothing is drawn to keeps it
  return texture;
}

std::vector<Image> imagesOf(const gpu::Texture& texture) {
  std::vector<Image> images;
  for (int layer = 0; layer < kLayers; ++layer)
    images.push_back(testing::device().download(texture, layer));
  return images;
}

bool same(const std::vector<Image>& a, const std::vector<Image>& b) {
  return std::ranges::equal(a, b, [](const Image& one, const Image& other) {
    return std::ranges::equal(one.bytes(), other.bytes());
  });
}

// Of lamps above the scene, of several sizes; or of suns, warped and not.
std::vector<Map> mapsOf(const scene::View& view, bool local) {
  const std::vector<scene::View> views{view};
  const Aabb boxW{vec3(-20), vec3(20)};
  std::vector<Map> maps;
  const auto add = [&](int layer, ivec2 corner, int side) {
    const float angle = 1.3f * static_cast<float>(maps.size());
    const vec3 eyeW(4.f * std::cos(angle), 4.f, 4.f * std::sin(angle));
    const vec3 axisW = -glm::normalize(eyeW);
    render::ShadowProjection projection;
    if (local) {
      const render::LightPyramid pyramid{.positionW = eyeW, .axisW = axisW, .reach = 30.f};
      projection = render::localProjection(pyramid, render::litBody(pyramid, views, boxW), 0.05f);
    } else {
      projection =
          render::directionalProjection(axisW, render::visibleBody(views, boxW), boxW,
                                        render::viewerOf(views), layer == 1 ? 0.f : 2.f, 0.05f);
    }
    maps.push_back({projection, {.local = local, .layer = layer, .corner = corner, .side = side}});
  };
  add(0, {0, 0}, kSide);
  if (local) {
    add(1, {64, 0}, 64);
    add(1, {0, 64}, 64);
    add(1, {16, 0}, 16);
    add(2, {64, 0}, 64);
  } else {
    add(1, {0, 0}, kSide);
    add(2, {0, 0}, kSide);
  }
  return maps;
}

TEST(DrawMaps, TogetherAsEachAlone) {
  gpu::Device& device = testing::device();
  const scene::Scene scene = testing::sampleScene();
  testing::SceneRenderer renderer(scene);
  const scene::View view = viewOf(scene, scene.cameras[0], 1.f);
  for (const bool local : {true, false}) {
    const std::vector<Map> maps = mapsOf(view, local);
    passes::MapDrawer oneByOne(device, false);
    const gpu::Texture alone = layers();
    for (const Map& map : maps) oneByOne.draw(renderer.gpuScene, alone, {}, {map});
    const std::vector<Image> wanted = imagesOf(alone);
    int shown = 0;
    for (const float depth : wanted[0].as<float>()) shown += depth > 0.f;
    EXPECT_GT(shown, kSide * kSide / 10);

    for (const bool layered : {false, true}) {
      const gpu::Texture together = layers();
      passes::MapDrawer drawer(device, layered);
      device.resetCounters();
      drawer.draw(renderer.gpuScene, together, {}, maps);
      EXPECT_TRUE(same(imagesOf(together), wanted)) << layered << local;
      drawer.draw(renderer.gpuScene, together, {}, maps);
      EXPECT_TRUE(same(imagesOf(together), wanted)) << "once more";
    }
  }
  EXPECT_TRUE(device.takeErrors().empty());
  testing::expectNoDebugMessages();
}

// As many draws for maps in three layers as for one.
TEST(DrawMaps, DrawsDoNotGrowWithTheLayers) {
  gpu::Device& device = testing::device();
  if (!device.capabilities().features.contains(gpu::kFeatureLayeredVertex)) GTEST_SKIP();
  const scene::Scene scene = testing::sampleScene();
  testing::SceneRenderer renderer(scene);
  Map map = mapsOf(viewOf(scene, scene.cameras[0], 1.f), true)[0];
  passes::MapDrawer drawer(device, true);
  const gpu::Texture texture = layers();
  const auto drawsOf = [&](const std::vector<Map>& maps) {
    device.resetCounters();
    drawer.draw(renderer.gpuScene, texture, {}, maps);
    return device.counters().draws;
  };
  std::vector<Map> maps{map};
  const std::uint64_t one = drawsOf(maps);
  EXPECT_GT(one, 0u);
  for (map.place.layer = 1; map.place.layer < kLayers; ++map.place.layer) maps.push_back(map);
  EXPECT_EQ(drawsOf(maps), one);
}

}  // namespace
}  // namespace lucerna
