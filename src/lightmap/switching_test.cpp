// Switching compared with sums of whole numbers, texel by texel.
#include "lightmap/switching.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <cstring>

#include "core/random.hpp"
#include "lightmap/texel_tiles.hpp"
#include "lightmap/unpack.hpp"

namespace lucerna::lightmap {
namespace {

constexpr int kSide = 60;  // the last tiles reach beyond
constexpr int kMaps = 2;

std::vector<Image> someBase(std::uint64_t seed) {
  Random random(seed);
  std::vector<Image> maps;
  for (int i = 0; i < kMaps; ++i) {
    maps.emplace_back(kSide, kSide, 3, ComponentType::F32);
    for (float& v : maps.back().as<float>()) v = std::exp(random.uniform(-8.f, 4.f));
  }
  maps[1].pixel<float>(9, 9)[0] = -0.f;
  return maps;
}

Patch tilePatch(Random& random, std::uint8_t channels) {
  TexelTiles texels(channels);
  const int left = static_cast<int>(random.below(kSide - 20)),
            top = static_cast<int>(random.below(kSide - 20));
  const auto map = static_cast<std::uint16_t>(random.below(kMaps));
  for (int y = top; y < top + 20; ++y)
    for (int x = left; x < left + 20; ++x) {
      if (random.below(5) == 0) continue;
      float* value = texels.add(map, x, y);
      for (int c = 0; c < channels; ++c)
        value[c * kTileTexels] = std::exp(random.uniform(-9.f, 3.f));
    }
  return {.group = "tiles",
          .color = vec3(1, 2, 3),
          .side = kSide,
          .maps = kMaps,
          .channels = channels,
          .tiles = encoded(texels)};
}

Patch trianglePatch(Random& random, std::uint8_t channels) {
  Patch patch{.group = "triangles",
              .color = vec3(3, 2, 1),
              .side = kSide,
              .maps = kMaps,
              .channels = channels};
  for (int i = 0; i < 6; ++i) {
    const auto corner = [&] {
      return ivec2(random.below(kSide * kPatchUnit), random.below(kSide * kPatchUnit));
    };
    patch.triangles.roots.push_back({.map = static_cast<std::uint16_t>(random.below(kMaps)),
                                     .borders = static_cast<std::uint8_t>(random.below(8)),
                                     .scale = 1e-4f,
                                     .corners = {corner(), corner(), corner()}});
    patch.triangles.nodes.push_back(PatchNode::Leaf);
    for (int v = 0; v < 3 * channels; ++v)
      patch.triangles.values.push_back(static_cast<std::uint16_t>(random.next()));
  }
  return patch;
}

std::vector<Patch> thirteen(std::uint64_t seed) {
  Random random(seed);
  std::vector<Patch> patches;
  for (int i = 0; i < 13; ++i) {
    const std::uint8_t channels = i % 4 < 2 ? 1 : 3;
    patches.push_back(i % 2 == 0 ? tilePatch(random, channels) : trianglePatch(random, channels));
  }
  return patches;
}

vec3 someColor(Random& random) {
  if (random.below(3) == 0) return vec3(0.f);
  const auto channel = [&] {
    return random.below(6) == 0 ? 0.f : std::exp(random.uniform(-8.f, 5.f));
  };
  return {channel(), channel(), channel()};
}

bool sameBits(const std::vector<Image>& a, const std::vector<Image>& b) {
  for (std::size_t i = 0; i < a.size(); ++i)
    if (std::memcmp(a[i].bytes().data(), b[i].bytes().data(), a[i].bytes().size()) != 0)
      return false;
  return a.size() == b.size();
}

SwitchedMaps switched(std::vector<Image> base, std::span<const Patch> patches) {
  Result<SwitchedMaps> maps = SwitchedMaps::create(std::move(base), patches);
  CHECK(maps, "{}", maps.error().message);
  return std::move(*maps);
}

TEST(SwitchedMaps, EndAtTheBaseAfterAHundredThousandSwitches) {
  const std::vector<Image> base = someBase(1);
  SwitchedMaps maps = switched(base, thirteen(2));
  Random random(3);
  for (int i = 0; i < 100000; ++i) {
    ASSERT_TRUE(maps.set(random.below(13), someColor(random)));
    if (i % 5000 == 0) maps.update();
  }
  maps.update();
  EXPECT_FALSE(sameBits(maps.maps(), base));
  for (std::size_t i = 0; i < 13; ++i) ASSERT_TRUE(maps.set(i, vec3(0.f)));
  maps.update();
  EXPECT_TRUE(sameBits(maps.maps(), base));
}

TEST(SwitchedMaps, DependOnThePresentColorsAlone) {
  const std::vector<Patch> patches = thirteen(4);
  std::vector<vec3> colors;
  Random random(5);
  for (int i = 0; i < 13; ++i) colors.push_back(someColor(random));
  SwitchedMaps inOrder = switched(someBase(6), patches);
  for (std::size_t i = 0; i < 13; ++i) ASSERT_TRUE(inOrder.set(i, colors[i]));
  inOrder.update();
  for (int round = 0; round < 20; ++round) {
    SwitchedMaps other = switched(someBase(6), patches);
    for (int i = 0; i < 200; ++i) ASSERT_TRUE(other.set(random.below(13), someColor(random)));
    std::vector<std::size_t> order = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12};
    for (std::size_t i = 12; i > 0; --i)
      std::swap(order[i], order[random.below(static_cast<std::uint32_t>(i + 1))]);
    for (const std::size_t i : order) ASSERT_TRUE(other.set(i, colors[i]));
    other.update();
    ASSERT_TRUE(sameBits(other.maps(), inOrder.maps())) << round;
  }
}

TEST(SwitchedMaps, AddValueTimesColor) {
  const std::vector<Image> base = someBase(7);
  const std::vector<Patch> patches = thirteen(8);
  const vec3 color(0.75f, 0.f, 11.f);
  for (const Patch& patch : patches) {
    SwitchedMaps maps = switched(base, std::span(&patch, 1));
    ASSERT_TRUE(maps.set(0, color));
    maps.update();
    TexelTiles values = decoded(unpacked(patch), patch.channels);
    for (int map = 0; map < kMaps; ++map)
      for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
          const float* value = values.find(static_cast<std::uint16_t>(map), x, y);
          for (int c = 0; c < 3; ++c) {
            const auto own = static_cast<std::size_t>(map);
            const double before = base[own].pixel<float>(x, y)[c];
            const double light =
                value == nullptr
                    ? 0.
                    : double{value[patch.channels == 1 ? 0 : c * kTileTexels]} * color[c];
            const double sum = before + light;
            ASSERT_NEAR(maps.maps()[own].pixel<float>(x, y)[c], sum,
                        0.5 * maps.resolution() + 4e-7 * sum)
                << patch.form() << ' ' << x << ' ' << y << ' ' << c;
          }
        }
  }
}

TEST(SwitchedMaps, HoldTheBrightestOfAllAtOnce) {
  // Thirteen over one another, each as bright as it may become.
  TexelTiles texel(1);
  *texel.add(0, 5, 5) = 1000.f;
  const Patch patch{.group = "sun",
                    .color = vec3(0.1f, 0.2f, 0.3f),
                    .side = kSide,
                    .maps = kMaps,
                    .tiles = encoded(texel)};
  const std::vector<Patch> patches(13, patch);
  SwitchedMaps maps = switched(someBase(9), patches);
  const vec3 most(SwitchedMaps::kHeadroom * 0.3f);
  for (std::size_t i = 0; i < 13; ++i) ASSERT_TRUE(maps.set(i, most));
  maps.update();
  EXPECT_NEAR(maps.maps()[0].pixel<float>(5, 5)[1],
              13 * 1000.f * most.y + someBase(9)[0].pixel<float>(5, 5)[1], 0.1f);
  for (std::size_t i = 0; i < 13; ++i) ASSERT_TRUE(maps.set(12 - i, vec3(0.f)));
  maps.update();
  EXPECT_TRUE(sameBits(maps.maps(), someBase(9)));
}

TEST(SwitchedMaps, RefuseColorsThatAreNone) {
  const std::vector<Patch> patches = thirteen(10);
  SwitchedMaps maps = switched(someBase(11), patches);
  ASSERT_TRUE(maps.set(2, vec3(1.f)));
  for (const float bad : {-1e-6f, std::nanf(""), INFINITY, 3.f * 65.f}) {
    const Status status = maps.set(2, vec3(0.f, bad, 0.f));
    ASSERT_FALSE(status);
    EXPECT_EQ(status.error().kind, ErrorKind::Usage);
    EXPECT_THAT(status.error().message, ::testing::HasSubstr("group 'tiles'"));
  }
  EXPECT_EQ(maps.color(2), vec3(1.f));
}

TEST(SwitchedMaps, SayWhichTilesChanged) {
  const std::vector<Patch> patches = thirteen(12);
  SwitchedMaps maps = switched(someBase(13), patches);
  EXPECT_TRUE(maps.update().empty());
  ASSERT_TRUE(maps.set(4, vec3(1.f)));
  ASSERT_TRUE(maps.set(1, vec3(0.f)));  // is off already
  const std::vector<TilePlace> changed = maps.update();
  std::vector<TilePlace> wanted;
  for (const LightTile& tile : unpacked(patches[4]).tiles) wanted.push_back(tile.place);
  EXPECT_EQ(changed, wanted);
  EXPECT_TRUE(maps.update().empty());
  const std::vector<Image> before = maps.maps();
  ASSERT_TRUE(maps.set(4, vec3(1.f)));  // has it already
  EXPECT_TRUE(maps.update().empty());
  // Whatever is not told has not changed.
  ASSERT_TRUE(maps.set(4, vec3(2.f, 1.f, 1.f)));
  const std::vector<TilePlace> again = maps.update();
  for (int map = 0; map < kMaps; ++map)
    for (int y = 0; y < kSide; ++y)
      for (int x = 0; x < kSide; ++x) {
        const TilePlace place{static_cast<std::uint16_t>(map),
                              static_cast<std::uint16_t>(x / kTileSide),
                              static_cast<std::uint16_t>(y / kTileSide)};
        if (std::binary_search(again.begin(), again.end(), place)) continue;
        const auto own = static_cast<std::size_t>(map);
        for (int c = 0; c < 3; ++c)
          ASSERT_EQ(maps.maps()[own].pixel<float>(x, y)[c], before[own].pixel<float>(x, y)[c]);
      }
}

TEST(SwitchedMaps, WantPatchesOfTheseMaps) {
  std::vector<Patch> patches = thirteen(14);
  patches[3].side = 64;
  const Result<SwitchedMaps> maps = SwitchedMaps::create(someBase(15), patches);
  ASSERT_FALSE(maps);
  EXPECT_EQ(maps.error().kind, ErrorKind::Input);
  EXPECT_THAT(maps.error().message, ::testing::HasSubstr("2 maps of 64 texels a side"));
}

TEST(SwitchedMaps, WithoutPatchesAreTheBase) {
  SwitchedMaps maps = switched(someBase(16), {});
  EXPECT_EQ(maps.count(), 0u);
  EXPECT_TRUE(maps.update().empty());
  EXPECT_TRUE(sameBits(maps.maps(), someBase(16)));
  const Patch empty{.group = "none", .side = kSide, .maps = kMaps};
  SwitchedMaps one = switched(someBase(16), std::span(&empty, 1));
  ASSERT_TRUE(one.set(0, vec3(7.f)));
  EXPECT_TRUE(one.update().empty());
}

}  // namespace
}  // namespace lucerna::lightmap
