// Levels of nearest depths against those found one by one.
#include "passes/nearest_blockers/nearest_blockers.hpp"

#include <gtest/gtest.h>

#include "core/random.hpp"
#include "support/testing.hpp"

namespace lucerna {
namespace {

gpu::Texture mapsOf(const std::vector<Image>& layers) {
  gpu::Texture maps = testing::device().createTexture({.kind = gpu::TextureKind::Array2D,
                                                       .format = gpu::Format::Depth32F,
                                                       .width = layers[0].width(),
                                                       .height = layers[0].height(),
                                                       .layers = static_cast<int>(layers.size())},
                                                      "maps");
  for (std::size_t i = 0; i < layers.size(); ++i)
    testing::device().upload(maps, layers[i], static_cast<int>(i));
  return maps;
}

std::vector<Image> randomDepths(int side, int layers, Random& random) {
  std::vector<Image> images;
  for (int i = 0; i < layers; ++i) {
    images.emplace_back(side, side, 1, ComponentType::F32);
    for (float& depth : images.back().as<float>()) depth = random.uniform();
  }
  return images;
}

// Of texels first to last along each axis, the last included.
float greatest(const Image& depths, ivec2 first, ivec2 last) {
  float value = 0.f;
  for (int y = first.y; y <= last.y; ++y)
    for (int x = first.x; x <= last.x; ++x) value = std::max(value, depths.pixel<float>(x, y)[0]);
  return value;
}

class NearestBlockers : public ::testing::Test {
 protected:
  void TearDown() override { testing::expectNoDebugMessages(); }

  void execute() {
    passes::NearestBlockers::Ports ports;
    ports.shadowMaps.bind(&maps_);
    ports.nearestBlockers.bind(&nearest_);
    graph::PassContext context{.device = testing::device()};
    pass_.execute(context, {}, ports);
  }

  passes::NearestBlockers pass_{testing::device()};
  render::ShadowMaps maps_;
  render::NearestBlockers nearest_;
};

TEST_F(NearestBlockers, AreTheGreatestDepthsOfEachBlock) {
  Random random(5);
  for (const int side : {8, 64, 104, 512}) {
    SCOPED_TRACE(side);
    const std::vector<Image> depths = randomDepths(side, 3, random);
    maps_.local = mapsOf(depths);
    maps_.directional = mapsOf(randomDepths(16, 1, random));
    ++maps_.revision;
    execute();
    const int levels = nearest_.local.desc().levels;
    EXPECT_EQ(std::max(nearest_.local.width() >> (levels - 1), 1), 1) << "up to the whole map";
    for (int layer = 0; layer < 3; ++layer)
      for (int level = 0; level < levels; ++level) {
        const Image found = testing::device().download(nearest_.local, layer, false, level);
        const int block = render::NearestBlockers::kBlock << level;
        for (int y = 0; y < found.height(); ++y)
          for (int x = 0; x < found.width(); ++x) {
            const ivec2 last(x + 1 == found.width() ? side - 1 : (x + 1) * block - 1,
                             y + 1 == found.height() ? side - 1 : (y + 1) * block - 1);
            ASSERT_EQ(found.pixel<float>(x, y)[0],
                      greatest(depths[static_cast<std::size_t>(layer)], ivec2(x, y) * block, last))
                << layer << " " << level << " " << x << " " << y;
          }
      }
  }
}

TEST_F(NearestBlockers, AreFoundAnewWhereMapsAre) {
  Random random(6);
  maps_.local = mapsOf(randomDepths(64, 1, random));
  maps_.directional = mapsOf(randomDepths(64, 1, random));
  ++maps_.revision;
  execute();
  const float before = testing::device().download(nearest_.local).pixel<float>(0, 0)[0];
  Image all(64, 64, 1, ComponentType::F32);
  std::ranges::fill(all.as<float>(), 0.5f * before);
  testing::device().upload(maps_.local, all);
  execute();
  EXPECT_EQ(testing::device().download(nearest_.local).pixel<float>(0, 0)[0], before);
  ++maps_.revision;
  execute();
  EXPECT_EQ(testing::device().download(nearest_.local).pixel<float>(0, 0)[0], 0.5f * before);
}

// Translucent surfaces have copies of their own while some map sees them; kept maps may come to see
// them again.
TEST_F(NearestBlockers, AreFoundOfPanes) {
  Random random(7);
  maps_.local = mapsOf(randomDepths(8, 1, random));
  maps_.directional = mapsOf(randomDepths(8, 1, random));
  const std::vector<Image> panes = randomDepths(8, 1, random);
  maps_.localPanes.depth = mapsOf(panes);
  maps_.directionalPanes.depth = mapsOf(randomDepths(8, 1, random));
  ++maps_.revision;
  for (const bool sees : {true, false, true}) {
    maps_.maps = {{.projection = {}, .place = {}, .seesPanes = sees}};
    execute();
    ASSERT_EQ(static_cast<bool>(nearest_.localPanes), sees);
    ASSERT_EQ(static_cast<bool>(nearest_.directionalPanes), sees);
    if (!sees) continue;
    EXPECT_EQ(testing::device().download(nearest_.localPanes).pixel<float>(0, 0)[0],
              greatest(panes[0], ivec2(0), ivec2(7)));
  }
}

}  // namespace
}  // namespace lucerna
