// Patches of made-up light, compared with it texel by texel.
#include "bake/make_patch.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "lightmap/switching.hpp"
#include "lightmap/unpack.hpp"

namespace lucerna::bake {
namespace {

constexpr int kSide = 128;
constexpr float kTolerance = 1.f / 255.f;

struct PatchTexel {
  std::uint16_t map = 0, x = 0, y = 0;
  vec3 value{0.f};  // irradiance
};

lightmap::HalfTiles tilesOf(const std::vector<PatchTexel>& texels) {
  lightmap::HalfTiles tiles(3);
  for (const PatchTexel& texel : texels)
    for (int c = 0; c < 3; ++c)
      tiles.add(texel.map, texel.x, texel.y)[c * lightmap::kTileTexels] =
          halfFromFloat(texel.value[c]);
  return tiles;
}
vec3 asHalves(vec3 v) {
  for (int c = 0; c < 3; ++c) v[c] = floatFromHalf(halfFromFloat(v[c]));
  return v;
}

// Charts: a rectangle of two triangles, a lone triangle, a strip askew; in two maps. Around each
// the gap is used too.
class Charts {
 public:
  Charts() {
    layout_ = {.side = kSide, .maps = 2, .charts = 3, .objects = {{}, {}}};
    addTriangle(0, 0, {vec2(2, 2), vec2(90, 2), vec2(90, 60)});
    addTriangle(0, 0, {vec2(2, 2), vec2(90, 60), vec2(2, 60)});
    addTriangle(0, 1, {vec2(3.25f, 66), vec2(120, 70.5f), vec2(60, 125.5f)});
    addTriangle(1, 2, {vec2(10, 10.5f), vec2(100.25f, 60), vec2(90, 80)});
    addTriangle(1, 2, {vec2(10, 10.5f), vec2(90, 80), vec2(6, 30)});
    // Without an area, and nowhere.
    addTriangle(1, 2, {vec2(5, 5), vec2(9, 9), vec2(7, 7)});
    layout_.objects[1].push_back({});
    used_.assign(2, std::vector<bool>(kSide * kSide));
    for (int map = 0; map < 2; ++map)
      for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x)
          used_[static_cast<std::size_t>(map)][static_cast<std::size_t>(y * kSide + x)] =
              distance(map, vec2(x, y) + 0.5f) < 1.5f;
  }

  const lightmap::Layout& layout() const { return layout_; }
  const std::vector<std::vector<bool>>& used() const { return used_; }

  // light(map, texel's middle). Beside a chart as at its border, as gaps are filled.
  std::vector<PatchTexel> lit(const std::function<vec3(int, vec2)>& light) const {
    std::vector<PatchTexel> texels;
    for (std::uint16_t map = 0; map < 2; ++map)
      for (std::uint16_t y = 0; y < kSide; ++y)
        for (std::uint16_t x = 0; x < kSide; ++x) {
          if (!used_[map][static_cast<std::size_t>(y) * kSide + x]) continue;
          const vec3 value = asHalves(light(map, nearest(map, vec2(x, y) + 0.5f)));
          if (value != vec3(0.f)) texels.push_back({map, x, y, value});
        }
    return texels;
  }

 private:
  void addTriangle(int map, std::uint32_t chart, std::array<vec2, 3> corners) {
    layout_.objects[0].push_back({.map = map, .chart = chart, .corners = corners});
  }
  static vec2 nearestOn(const std::array<vec2, 3>& t, vec2 p) {
    const auto side = [&](vec2 a, vec2 b) {
      return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
    };
    const float s[3] = {side(t[0], t[1]), side(t[1], t[2]), side(t[2], t[0])};
    if ((s[0] > 0 && s[1] > 0 && s[2] > 0) || (s[0] < 0 && s[1] < 0 && s[2] < 0)) return p;
    vec2 best = t[0];
    for (std::size_t i = 0; i < 3; ++i) {
      const vec2 a = t[i], along = t[(i + 1) % 3] - a;
      const vec2 q =
          a + along * std::clamp(glm::dot(p - a, along) / glm::dot(along, along), 0.f, 1.f);
      if (glm::distance(p, q) < glm::distance(p, best)) best = q;
    }
    return best;
  }
  vec2 nearest(int map, vec2 p) const {
    vec2 best(1e9f);
    for (const lightmap::TrianglePlace& place : layout_.objects[0]) {
      if (place.map != map) continue;
      const vec2 q = nearestOn(place.corners, p);
      if (glm::distance(p, q) < glm::distance(p, best)) best = q;
    }
    return best;
  }
  float distance(int map, vec2 p) const { return glm::distance(p, nearest(map, p)); }

  lightmap::Layout layout_;
  std::vector<std::vector<bool>> used_;
};

const Charts& charts() {
  static const Charts made;
  return made;
}

vec3 smooth(int map, vec2 p) {
  const vec2 lamp = map == 0 ? vec2(60, 40) : vec2(50, 45);
  const float d = glm::distance(p, lamp) / 40.f;
  return vec3(0.8f * std::max(1.f - d * d, 0.f));
}

// A lamp behind a post: an edge of shadow straight across.
vec3 hardEdged(int map, vec2 p) {
  return p.x + 0.37f * p.y < 55.f ? smooth(map, p) : vec3(0.f);
}

MadePatch made(const std::vector<PatchTexel>& texels, vec3 color, PatchTolerance tolerance = {}) {
  return PatchMaker(charts().layout(), charts().used())
      .make({.group = "lamps", .color = color, .irradiance = tilesOf(texels)}, tolerance);
}

// By switching it on over nothing: the largest difference of any used texel.
float worstDifference(const MadePatch& made, const std::vector<PatchTexel>& texels) {
  const Result<lightmap::Patch> patch = lightmap::patchFrom(made.bytes, "patch.bin");
  CHECK(patch, "{}", patch.error().message);
  std::vector<Image> dark(2, Image(kSide, kSide, 3, ComponentType::F32));
  std::vector<Image> wanted = dark;
  for (const PatchTexel& texel : texels)
    for (int c = 0; c < 3; ++c)
      wanted[texel.map].pixel<float>(texel.x, texel.y)[c] = texel.value[c];
  Result<lightmap::SwitchedMaps> maps =
      lightmap::SwitchedMaps::create(std::move(dark), std::span(&*patch, 1));
  CHECK(maps && maps->set(0, patch->color));
  maps->update();
  float worst = 0.f;
  for (std::size_t map = 0; map < 2; ++map)
    for (std::size_t i = 0; i < kSide * kSide; ++i)
      if (charts().used()[map][i])
        for (std::size_t c = 0; c < 3; ++c)
          worst = std::max(worst, std::abs(maps->maps()[map].as<float>()[i * 3 + c] -
                                           wanted[map].as<float>()[i * 3 + c]));
  return worst;
}

TEST(MakePatch, SmoothLightIsTrianglesWithinTheTolerance) {
  const std::vector<PatchTexel> texels = charts().lit(smooth);
  const MadePatch patch = made(texels, vec3(2.f));
  EXPECT_EQ(patch.patch.form(), "triangles");
  EXPECT_EQ(patch.patch.channels, 1);
  EXPECT_LT(patch.bytes.size() * 3, patch.otherBytes * 2);
  EXPECT_LE(patch.worst, kTolerance);
  EXPECT_NEAR(worstDifference(patch, texels), patch.worst, 1e-6f);
  EXPECT_GT(patch.worst, kTolerance / 10.f);  // triangles use what they are given
}

TEST(MakePatch, HardEdgesStayWithinTheTolerance) {
  const std::vector<PatchTexel> texels = charts().lit(hardEdged);
  const MadePatch patch = made(texels, vec3(1.f));
  EXPECT_EQ(patch.patch.form(), "triangles");
  EXPECT_LE(patch.worst, kTolerance);
  EXPECT_LE(worstDifference(patch, texels), kTolerance);
}

TEST(MakePatch, ALargerToleranceTakesFewerBytes) {
  const std::vector<PatchTexel> texels = charts().lit(smooth);
  const MadePatch fine = made(texels, vec3(1.f), {.light = 0.001f, .black = 0.0001f}),
                  coarse = made(texels, vec3(1.f), {.light = 0.02f, .black = 0.0001f});
  EXPECT_LT(coarse.bytes.size(), fine.bytes.size());
  EXPECT_LE(worstDifference(fine, texels), 0.001f);
  EXPECT_LE(worstDifference(coarse, texels), 0.02f);
}

TEST(MakePatch, NoiseIsTiles) {
  const std::vector<PatchTexel> texels = charts().lit(
      [](int, vec2 p) { return vec3(0.5f + 0.5f * std::sin(p.x * 12.9898f + p.y * 78.233f)); });
  const MadePatch patch = made(texels, vec3(1.f));
  EXPECT_EQ(patch.patch.form(), "tiles");
  EXPECT_GE(patch.otherBytes, patch.bytes.size());
  EXPECT_LE(worstDifference(patch, texels), 1.f / 4096.f);
}

TEST(MakePatch, OneColorIsOneValueAndTwoAreThree) {
  const vec3 amber(3.f, 1.5f, 0.f);
  const std::vector<PatchTexel> one =
      charts().lit([&](int map, vec2 p) { return amber * smooth(map, p).x; });
  const MadePatch scalar = made(one, amber);
  EXPECT_EQ(scalar.patch.channels, 1);
  EXPECT_EQ(scalar.patch.color, amber);
  EXPECT_LE(worstDifference(scalar, one), kTolerance);

  // Behind a pane the light is red.
  const std::vector<PatchTexel> tinted = charts().lit([&](int map, vec2 p) {
    return (p.x < 50.f ? amber : amber * vec3(1.f, 0.5f, 0.f)) * smooth(map, p).x;
  });
  const MadePatch colors = made(tinted, amber);
  EXPECT_EQ(colors.patch.channels, 3);
  EXPECT_EQ(colors.patch.color, vec3(3.f, 1.5f, 1.f));  // of blue nothing can be factored out
  EXPECT_LE(worstDifference(colors, tinted), kTolerance);
  EXPECT_GT(colors.bytes.size(), scalar.bytes.size());
}

TEST(MakePatch, AnEmptyOneAndOneTexel) {
  const MadePatch empty = made({}, vec3(1.f));
  EXPECT_EQ(empty.patch.form(), "tiles");
  EXPECT_TRUE(empty.patch.tiles.tiles.empty());
  EXPECT_EQ(empty.worst, 0.f);
  EXPECT_EQ(worstDifference(empty, {}), 0.f);

  const std::vector<PatchTexel> texel = {{1, 40, 40, vec3(0.25f, 0.5f, 0.75f)}};
  const MadePatch one = made(texel, vec3(1, 2, 3));
  EXPECT_EQ(one.patch.form(), "tiles");
  ASSERT_EQ(one.patch.tiles.tiles.size(), 1u);
  EXPECT_EQ(one.patch.tiles.tiles[0].mask, 1u);
  EXPECT_EQ(one.patch.channels, 1);
  EXPECT_LE(worstDifference(one, texel), 1e-5f);
}

TEST(MakePatch, WhatIsBlackIsDropped) {
  const std::vector<PatchTexel> texels =
      charts().lit([](int map, vec2) { return vec3(map == 0 ? 0.0001f : 0.5f); });
  const MadePatch patch = made(texels, vec3(1.f));
  for (const lightmap::LightTile& tile : lightmap::unpacked(patch.patch).tiles)
    EXPECT_EQ(tile.place.map, 1);
  EXPECT_LE(worstDifference(patch, texels), kTolerance);
}

TEST(MakePatch, ALightWithoutColorOrOnNoChartHasAPatch) {
  // Texels on no chart, as no layout has them: tiles hold them.
  const std::vector<PatchTexel> texels = {{0, 127, 0, vec3(1.f)}, {0, 127, 127, vec3(0.5f)}};
  EXPECT_LE(made(texels, vec3(1.f)).worst, 1e-4f);
  const MadePatch dark = made(texels, vec3(0.f));
  EXPECT_EQ(dark.patch.color, vec3(1.f));
  EXPECT_LE(dark.worst, 1e-4f);
}

}  // namespace
}  // namespace lucerna::bake
