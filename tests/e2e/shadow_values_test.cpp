// What ShadowMask stores of each pixel and layer: bytes against their closed form.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "layer_stage.hpp"
#include "passes/shadow_mask/shadow_mask.hpp"

namespace lucerna {
namespace {

constexpr uvec2 kSize{256, 64};

using Params = passes::ShadowMask::Params;
constexpr auto kExponential = passes::ShadowMask::Values::Exponential;

struct Masks {
  Image bits;
  std::vector<Image> bytes = {};  // four layers in each

  bool blocked(int x, int y, int layer) const {
    return (*bits.pixel<std::uint32_t>(x, y) >> layer & 1u) != 0;
  }
  int byte(int x, int y, int layer) const {
    const Image& four = bytes[static_cast<std::size_t>(layer) / 4];
    return static_cast<int>(*four.pixel<std::uint32_t>(x, y) >> (8 * (layer % 4)) & 255u);
  }
};

Masks masksOf(const testing::LayerStage& stage, const Params& params) {
  gpu::Texture mask = testing::device().createTexture({.format = gpu::Format::R32Uint,
                                                       .width = stage.depth.width(),
                                                       .height = stage.depth.height()},
                                                      "mask");
  render::ShadowValues values;
  passes::ShadowMask::Ports ports;
  stage.bind(ports);
  ports.shadowMask.bind(&mask);
  if (params.values == kExponential) ports.shadowValues.bind(&values);
  graph::PassContext context{.device = testing::device()};
  passes::ShadowMask(testing::device()).execute(context, params, ports);
  Masks masks{.bits = testing::device().download(mask)};
  EXPECT_EQ(values.layers, params.values == kExponential ? stage.layers.count : 0);
  for (int i = 0; i < render::arrayLayersOf(values.layers); ++i)
    masks.bytes.push_back(testing::device().download(values.bytes, i));
  return masks;
}

Params exponential(float falloff) {
  Params params;
  params.values = kExponential;
  params.falloff = falloff;
  return params;
}

// The wall is 3 m behind the half-plane, along the lamp's axis.
TEST(ShadowValues, AreExponentialsOfTheWayBehindTheBlocker) {
  const scene::Scene scene = testing::halfPlane(0.f);
  const testing::LayerStage stage(scene, kSize, {.localSize = 2048});
  const Masks hard = masksOf(stage, {});
  for (const float falloff : {0.1f, 0.2f, 0.3f, 0.7f, 20.f}) {
    SCOPED_TRACE(falloff);
    const Masks masks = masksOf(stage, exponential(falloff));
    const double byte = 255. * std::exp(-falloff * 0.5 * testing::kHalfPlaneWall);
    int blocked = 0, lit = 0;
    for (int y = 0; y < static_cast<int>(kSize.y); ++y)
      for (int x = 0; x < static_cast<int>(kSize.x); ++x) {
        const bool dark = hard.blocked(x, y, 0);
        // The half-plane is 1 mm thick, and what is its nearest in a texel may be its side.
        ASSERT_NEAR(masks.byte(x, y, 0), dark ? byte : 255., dark ? 1. : 0.) << x << ", " << y;
        ASSERT_EQ(masks.blocked(x, y, 0), masks.byte(x, y, 0) < 128) << x << ", " << y;
        for (int other = 1; other < 4; ++other) ASSERT_EQ(masks.byte(x, y, other), 255);
        (dark ? blocked : lit) += 1;
      }
    EXPECT_GT(blocked, 500);
    EXPECT_GT(lit, 500);
  }
  testing::expectNoDebugMessages();
}

// 32 lamps fill all bytes and all targets: each has its own shadow in its own byte.
TEST(ShadowValues, OfEachLayerAreThoseOfItsBit) {
  scene::Scene scene = testing::emptyScene();
  testing::addWall(scene, 6.f);
  testing::addBox(scene, {0, 0, -4.5f}, vec3(0.6f));
  for (int i = 0; i < 32; ++i) {
    scene::Light light;
    light.kind = i % 2 == 0 ? scene::LightKind::Spot : scene::LightKind::Point;
    light.intensity = 50.f;
    const float x = 4.f * ((static_cast<float>(i) + 0.5f) / 32.f - 0.5f);
    testing::addLight(scene, light, {x, 0.7f, -0.5f}, {0, 0, -6});
  }
  updateTransforms(scene);
  const testing::LayerStage stage(scene, kSize, {.localSize = 512}, {.layers = 32});
  ASSERT_EQ(stage.layers.count, 32);
  const Masks hard = masksOf(stage, {}), masks = masksOf(stage, exponential(20.f));
  ASSERT_EQ(masks.bytes.size(), 8u);
  std::uint32_t together = 0;
  int different = 0;
  for (int y = 0; y < static_cast<int>(kSize.y); ++y)
    for (int x = 0; x < static_cast<int>(kSize.x); ++x)
      for (int layer = 0; layer < 32; ++layer) {
        const bool dark = masks.blocked(x, y, layer);
        ASSERT_EQ(dark, masks.byte(x, y, layer) < 128);
        together |= dark ? 1u << layer : 0u;
        different += dark != hard.blocked(x, y, layer);
      }
  EXPECT_EQ(together, 0xffffffffu);
  EXPECT_LT(different, 30) << "bits are the mean of four depths, values are of the nearest";
  testing::expectNoDebugMessages();
}

// Without any offset half of a plane that light falls on at a slant is behind what a texel of its
// map says: dark if light goes out at once, hardly darker by a gentle falloff.
TEST(ShadowValues, OfAPlaneThatNothingBlocksAreNearlyAll) {
  scene::Scene scene = testing::emptyScene();
  testing::addWall(scene, 6.f);
  scene::Light light;
  light.kind = scene::LightKind::Spot;
  light.intensity = 100.f;
  light.outerCone = 1.f;
  testing::addLight(scene, light, {-6, 0, -3}, {0, 0, -6});
  updateTransforms(scene);
  constexpr int kSide = 64;  // px: all is wall, in the light
  const testing::LayerStage stage(scene, uvec2(kSide), {.localSize = 1024});
  Params params;
  params.values = kExponential;
  params.bias = params.normalBias = 0.f;
  const Masks soft = masksOf(stage, params);
  params.falloff = 1000.f;
  const Masks hard = masksOf(stage, params);
  int hardBlocked = 0, softBlocked = 0, pixels = 0;
  double sum = 0;
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      hardBlocked += hard.blocked(x, y, 0), softBlocked += soft.blocked(x, y, 0), ++pixels;
      sum += soft.byte(x, y, 0) / 255.;
    }
  EXPECT_GT(hardBlocked, 0.3 * pixels);
  EXPECT_LT(softBlocked, 0.001 * pixels);
  EXPECT_GT(sum, 0.95 * pixels);
  testing::expectNoDebugMessages();
}

}  // namespace
}  // namespace lucerna
