// What texels that have no samples are filled with, and units of light that are no light.
#include "bake/assemble.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "bake/light_scenes.hpp"

namespace lucerna::bake {
namespace {

using scene::LightKind;
using testing::addLight;
using testing::addRectangle;
using testing::addSurface;
using testing::planOf;

std::array<std::uint16_t, 3> grey(float value) {
  const std::uint16_t half = halfFromFloat(value);
  return {half, half, half};
}

constexpr int kSide = 8;
std::size_t index(ivec2 p) {
  return static_cast<std::size_t>(p.y) * kSide + p.x;
}

// A map with a group, both with the same light: of touched texels.
struct Filled {
  BakedLight baked;
  Filled() {
    baked.texels.side = kSide;
    for (auto* list : {&baked.texels.touched, &baked.texels.hidden})
      list->assign(1, std::vector<bool>(index({0, kSide})));
    baked.maps.emplace_back(kSide, kSide, 3, ComponentType::Half);
    baked.groups.resize(2, lightmap::HalfTiles(3));
  }
  void touch(ivec2 p, float light) {
    baked.texels.touched[0][index(p)] = true;
    std::ranges::copy(grey(light), baked.maps[0].pixel<std::uint16_t>(p.x, p.y));
    if (light > 0.f)
      for (std::size_t c = 0; c < 3; ++c)
        baked.groups[1].add(0, p.x, p.y)[c * lightmap::kTileTexels] = grey(light)[c];
  }
  void hide(ivec2 p) { baked.texels.hidden[0][index(p)] = true; }
  void expect(ivec2 p, float light) {
    EXPECT_EQ(floatFromHalf(baked.maps[0].pixel<std::uint16_t>(p.x, p.y)[0]), light)
        << p.x << ' ' << p.y;
    const std::uint16_t* red = baked.groups[1].find(0, p.x, p.y);
    EXPECT_EQ(red ? floatFromHalf(*red) : 0.f, light) << p.x << ' ' << p.y;
  }
};

// A chart of two columns beside an empty one.
TEST(Dilate, GoesStraightOnBesideCharts) {
  Filled f;
  for (int y = 2; y < 6; ++y) {
    f.touch({2, y}, 8.f);
    f.touch({3, y}, static_cast<float>(y));
  }
  dilate(f.baked);
  for (int y = 2; y < 6; ++y) f.expect({4, y}, static_cast<float>(y));
  f.expect({4, 1}, 2.f);  // at the corner
  f.expect({4, 6}, 5.f);
  f.expect({3, 1}, 2.f);
  f.expect({5, 3}, 0.f);
}

TEST(Dilate, MeetsBetweenCharts) {
  Filled f;
  f.touch({2, 2}, 1.f);
  f.touch({4, 2}, 4.f);
  dilate(f.baked);
  f.expect({3, 2}, 2.5f);
  f.expect({3, 3}, 2.5f);  // at corners of both
}

TEST(Dilate, HiddenTexelsGetTheDarkest) {
  Filled f;
  for (int y = 2; y < 6; ++y) f.touch({3, y}, static_cast<float>(y));
  for (int y = 2; y < 6; ++y) f.hide({4, y});
  dilate(f.baked);
  for (int y = 2; y < 6; ++y) f.expect({4, y}, static_cast<float>(std::max(y - 1, 2)));
  f.expect({2, 3}, 3.f);  // beside the chart
}

// A floor that ends 2/1000 of a texel past a texel's edge. These texels are the chart's, but too
// little of them to have a sample.
struct Floor {
  scene::Scene scene;
  Plan plan;
  Floor() {
    scene = trace::testing::emptyScene();
    addSurface(scene);
    addRectangle(scene, vec3(0), vec3(0, 0, 0.5001f), vec3(0.5001f, 0, 0));
    addLight(scene, LightKind::Point, vec3(0.2f, 0.3f, 0.1f), vec3(0, -1, 0)).intensity = 3.f;
    plan = planOf(scene, {.density = 10.f});
  }
  UnitLight light() {
    const LightScene lightScene(plan);
    return UnitLighter(plan, lightScene).light(plan.units[0]);
  }
};

TEST(PutInMaps, ATexelTooLittleOfWhichIsTheChartsIsBesideIt) {
  Floor floor;
  ASSERT_EQ(floor.plan.units.size(), 1u);
  ASSERT_EQ(floor.plan.charts.charts[0].size, ivec2(11));
  ASSERT_TRUE(floor.plan.packed.masks[0].at(10, 5));
  BakedLight baked = emptyLight(floor.plan);
  putInMaps(baked, floor.plan, floor.plan.units[0], floor.light());
  dilate(baked);
  const auto at = [&](int x, int y) {
    const ivec2 p = placed(floor.plan, 0, ivec2(x, y));
    EXPECT_FALSE(baked.texels.isHidden(0, p));
    EXPECT_EQ(baked.texels.has(0, p), x < 10 && y < 10);
    return floatFromHalf(baked.maps[0].pixel<std::uint16_t>(p.x, p.y)[0]);
  };
  bool differs = false;
  for (int i = 0; i < 10; ++i) {
    EXPECT_EQ(at(10, i), at(9, i)) << i;
    EXPECT_EQ(at(i, 10), at(i, 9)) << i;
    differs = differs || (i > 0 && at(9, i) > at(9, i - 1));
  }
  EXPECT_TRUE(differs);  // so that the darkest of three would be another
}

class UnitLightBytes : public ::testing::Test {
 protected:
  // Whether they are light of the unit.
  bool isLight(const UnitLight& light) {
    return unitLightFrom(toBytes(light), floor_.plan, floor_.plan.units[0]).has_value();
  }
  Floor floor_;
  UnitLight light_ = floor_.light();
  BlockLight& block_ = light_.blocks[0];
};

TEST_F(UnitLightBytes, GoThereAndBack) {
  block_.hidden.assign(block_.touched.size(), 0);
  block_.hidden[1] = static_cast<std::uint8_t>(~block_.touched[1]);
  const auto back = unitLightFrom(toBytes(light_), floor_.plan, floor_.plan.units[0]);
  ASSERT_TRUE(back);
  ASSERT_EQ(back->blocks.size(), 1u);
  EXPECT_EQ(back->blocks[0].touched, block_.touched);
  EXPECT_EQ(back->blocks[0].hidden, block_.hidden);
  ASSERT_EQ(back->blocks[0].groups.size(), 1u);
  EXPECT_EQ(back->blocks[0].groups[0].rgb, block_.groups[0].rgb);
}

TEST_F(UnitLightBytes, OfTheWrongCountsAreNone) {
  const UnitLight sound = light_;
  ASSERT_TRUE(isLight(sound));
  const auto expectNone = [&](const char* what, const auto& spoil) {
    light_ = sound;
    spoil();
    EXPECT_FALSE(isLight(light_)) << what;
  };
  expectNone("no block", [&] { light_.blocks.clear(); });
  expectNone("two blocks", [&] { light_.blocks.push_back(sound.blocks[0]); });
  expectNone("few bits", [&] { light_.blocks[0].touched.pop_back(); });
  expectNone("many bits", [&] { light_.blocks[0].touched.push_back(0); });
  expectNone("a bit more", [&] { light_.blocks[0].touched[0] ^= 0x80; });
  expectNone("bits beyond the block", [&] { light_.blocks[0].touched.back() |= 0x80; });
  expectNone("few hidden bits", [&] { light_.blocks[0].hidden = {0}; });
  expectNone("hidden and touched", [&] { light_.blocks[0].hidden = sound.blocks[0].touched; });
  expectNone("a group that is none", [&] { light_.blocks[0].groups[0].group = 1; });
  expectNone("little light", [&] { light_.blocks[0].groups[0].rgb.pop_back(); });
  expectNone("much light", [&] { light_.blocks[0].groups[0].rgb.push_back(0); });
}

TEST_F(UnitLightBytes, ThatAreTornAreNone) {
  const Bytes bytes = toBytes(light_);
  for (std::size_t size = 0; size < bytes.size(); size += 7)
    EXPECT_FALSE(unitLightFrom(std::span(bytes).first(size), floor_.plan, floor_.plan.units[0]));
  Bytes longer = bytes;
  longer.push_back(std::byte{0});
  EXPECT_FALSE(unitLightFrom(longer, floor_.plan, floor_.plan.units[0]));
}

}  // namespace
}  // namespace lucerna::bake
