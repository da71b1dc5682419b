// Packings whose texels are counted one by one.
#include "bake/pack.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "core/random.hpp"

namespace lucerna::bake {
namespace {

using ::testing::HasSubstr;

// Sides from 1 texel on, small ones more often, as charts of a city have them.
std::vector<ivec2> someSizes(std::size_t count, float most, std::uint64_t seed) {
  Random random(seed);
  std::vector<ivec2> sizes;
  const auto side = [&] { return static_cast<int>(std::exp(random.uniform(0.f, std::log(most)))); };
  for (std::size_t i = 0; i < count; ++i) sizes.emplace_back(side(), side());
  return sizes;
}

// Each rectangle has its texels and those of the gap around it for itself.
void expectApart(const Packing& packing, std::span<const ivec2> sizes,
                 const PackSettings& settings) {
  const int side = settings.side;
  std::vector<std::vector<std::uint32_t>> owners(
      static_cast<std::size_t>(packing.maps),
      std::vector<std::uint32_t>(static_cast<std::size_t>(side) * static_cast<std::size_t>(side),
                                 0));
  const auto at = [&](int map, int x, int y) -> std::uint32_t& {
    return owners[static_cast<std::size_t>(map)]
                 [static_cast<std::size_t>(y) * static_cast<std::size_t>(side) +
                  static_cast<std::size_t>(x)];
  };
  ASSERT_EQ(packing.places.size(), sizes.size());
  for (std::uint32_t i = 0; i < sizes.size(); ++i) {
    const Place& place = packing.places[i];
    const ivec2 end = place.corner + placedSize(place, sizes[i]);
    ASSERT_TRUE(place.map >= 0 && place.map < packing.maps) << i;
    ASSERT_TRUE(glm::all(glm::greaterThanEqual(place.corner, ivec2(0)))) << i;
    ASSERT_TRUE(glm::all(glm::lessThanEqual(end, ivec2(side)))) << i;
    for (int y = place.corner.y; y < end.y; ++y)
      for (int x = place.corner.x; x < end.x; ++x) {
        ASSERT_EQ(at(place.map, x, y), 0u) << i << " lies on " << at(place.map, x, y) - 1;
        at(place.map, x, y) = i + 1;
      }
  }
  for (std::uint32_t i = 0; i < sizes.size(); ++i) {
    const Place& place = packing.places[i];
    const ivec2 end =
        glm::min(place.corner + placedSize(place, sizes[i]) + settings.gap, ivec2(side));
    for (int y = std::max(place.corner.y - settings.gap, 0); y < end.y; ++y)
      for (int x = std::max(place.corner.x - settings.gap, 0); x < end.x; ++x) {
        const std::uint32_t owner = at(place.map, x, y);
        ASSERT_TRUE(owner == 0 || owner == i + 1) << owner - 1 << " is too near to " << i;
      }
  }
}

TEST(Pack, KeepsRectanglesApart) {
  for (const int gap : {0, 1, 2, 5})
    for (const std::size_t count : {0u, 1u, 2u, 3000u}) {
      SCOPED_TRACE(count);
      const PackSettings settings{.side = 256, .gap = gap};
      const auto sizes = someSizes(count, 100.f, 3);
      const auto packing = pack(sizes, settings);
      ASSERT_TRUE(packing) << packing.error().message;
      expectApart(*packing, sizes, settings);
      EXPECT_EQ(packing->maps == 0, count == 0);
    }
}

TEST(Pack, FillsMaps) {
  const PackSettings settings{.side = 1024, .gap = 2};
  const auto sizes = someSizes(20000, 200.f, 4);
  const auto packing = pack(sizes, settings);
  ASSERT_TRUE(packing);
  EXPECT_GT(packing->maps, 3);
  EXPECT_GT(occupancy(*packing, sizes, settings.side), 0.85);
}

TEST(Pack, FillsAMapWithEqualSquares) {
  const std::vector<ivec2> sizes(64, ivec2(30));
  const auto packing = pack(sizes, {.side = 8 * 32 - 2, .gap = 2});
  ASSERT_TRUE(packing);
  EXPECT_EQ(packing->maps, 1);
}

TEST(Pack, GivesTheSameForTheSame) {
  const auto sizes = someSizes(2000, 100.f, 5);
  const auto first = pack(sizes, {.side = 512}), second = pack(sizes, {.side = 512});
  ASSERT_TRUE(first && second);
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    EXPECT_EQ(first->places[i].map, second->places[i].map);
    EXPECT_EQ(first->places[i].corner, second->places[i].corner);
    EXPECT_EQ(first->places[i].turned, second->places[i].turned);
  }
}

TEST(Pack, SaysWhatDoesNotFit) {
  const std::vector<ivec2> large{{10, 10}, {100, 400}};
  const auto tooLarge = pack(large, {.side = 200});
  ASSERT_FALSE(tooLarge);
  EXPECT_EQ(tooLarge.error().kind, ErrorKind::Input);
  EXPECT_THAT(tooLarge.error().message, HasSubstr("chart 1 has 100 x 400 texels"));
  EXPECT_THAT(tooLarge.error().message, HasSubstr("0.5 of this one"));
  const std::vector<ivec2> many(16, ivec2(100));
  const auto tooMany = pack(many, {.side = 100, .mostMaps = 4});
  ASSERT_FALSE(tooMany);
  EXPECT_EQ(tooMany.error().kind, ErrorKind::Usage);
  EXPECT_EQ(tooMany.error().message,
            "16 charts need about 16 maps of 100 x 100 texels, and --most-maps allows 4");
  const auto small = pack(std::vector<ivec2>(400, ivec2(18)), {.side = 98, .mostMaps = 4});
  ASSERT_FALSE(small);  // 25 in each, so 16 are enough
  EXPECT_THAT(small.error().message, HasSubstr("400 charts need about 17 maps"));
}

}  // namespace
}  // namespace lucerna::bake
