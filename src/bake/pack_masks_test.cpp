// Packings of which each texel is painted.
#include "bake/pack_masks.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/random.hpp"

namespace lucerna::bake {
namespace {

using ::testing::HasSubstr;
using Chart = std::vector<FlatTriangle>;

void addRectangle(Chart& chart, vec2 low, vec2 high) {
  chart.push_back({low, vec2(high.x, low.y), high});
  chart.push_back({low, high, vec2(low.x, high.y)});
}

// Triangles, rectangles, Ls, frames and fans, mostly small, anywhere in the plane.
Chart someChart(Random& random, float most) {
  const auto side = [&] { return std::exp(random.uniform(std::log(0.1f), std::log(most))); };
  const vec2 size(side(), side()), low(random.uniform(-50.f, 50.f), random.uniform(-50.f, 50.f));
  const vec2 part = size * random.uniform(0.1f, 0.4f), high = low + size;
  Chart chart;
  switch (random.below(5)) {
    case 0:
      chart = {{low, high, vec2(random.uniform(low.x, high.x), low.y)}};
      break;
    case 1:
      addRectangle(chart, low, high);
      break;
    case 2:
      addRectangle(chart, low, {high.x, low.y + part.y});
      addRectangle(chart, low, {low.x + part.x, high.y});
      break;
    case 3:
      addRectangle(chart, low, {high.x, low.y + part.y});
      addRectangle(chart, {low.x, high.y - part.y}, high);
      addRectangle(chart, low, {low.x + part.x, high.y});
      addRectangle(chart, {high.x - part.x, low.y}, high);
      break;
    default:
      for (int i = 0; i < 7; ++i) {
        const auto rim = [&](int k) {
          const float angle = static_cast<float>(k);
          return low + size * (0.5f + 0.5f * vec2(std::cos(angle), std::sin(angle)));
        };
        chart.push_back({low + 0.5f * size, rim(i), rim(i + 1)});
      }
  }
  return chart;
}

std::vector<Chart> someCharts(std::size_t count, float most, std::uint64_t seed) {
  Random random(seed);
  std::vector<Chart> charts;
  for (std::size_t i = 0; i < count; ++i) charts.push_back(someChart(random, most));
  return charts;
}

Result<PackedCharts> packed(const std::vector<Chart>& charts, const PackSettings& settings) {
  const std::vector<std::span<const FlatTriangle>> spans(charts.begin(), charts.end());
  return packCharts(spans, settings);
}

// The owner of each texel of each map: 0, or the chart's number and 1.
class Painting {
 public:
  Painting(int maps, int side)
      : side_(side),
        owners_(static_cast<std::size_t>(maps) *
                static_cast<std::size_t>(std::ptrdiff_t{side} * side)) {}

  bool has(ivec2 texel) const {
    return std::min(texel.x, texel.y) >= 0 && std::max(texel.x, texel.y) < side_;
  }
  std::uint32_t& at(int map, ivec2 texel) {
    return owners_[static_cast<std::size_t>((std::ptrdiff_t{map} * side_ + texel.y) * side_ +
                                            texel.x)];
  }
  // Someone else's number where there is one less than gap + 1 texels away.
  std::uint32_t neighbour(int map, ivec2 texel, int gap, std::uint32_t owner) {
    for (int y = -gap; y <= gap; ++y)
      for (int x = -gap; x <= gap; ++x)
        if (const ivec2 other = texel + ivec2(x, y); has(other))
          if (at(map, other) != 0 && at(map, other) != owner) return at(map, other);
    return 0;
  }

 private:
  int side_;
  std::vector<std::uint32_t> owners_;
};

std::vector<ivec2> placedTexels(const TexelMask& mask, const Place& place) {
  std::vector<ivec2> texels;
  for (int y = 0; y < mask.size().y; ++y)
    for (int x = 0; x < mask.size().x; ++x)
      if (mask.at(x, y))
        texels.emplace_back(glm::floor(placedPoint(place, mask.size(), vec2(x, y) + 0.5f)));
  return texels;
}

void expectApart(const Packing& packing, std::span<const TexelMask> masks,
                 const PackSettings& settings) {
  ASSERT_EQ(packing.places.size(), masks.size());
  Painting painting(packing.maps, settings.side);
  for (std::uint32_t i = 0; i < masks.size(); ++i) {
    const Place& place = packing.places[i];
    ASSERT_TRUE(place.map >= 0 && place.map < packing.maps) << i;
    for (const ivec2 texel : placedTexels(masks[i], place)) {
      ASSERT_TRUE(painting.has(texel)) << i;
      std::uint32_t& owner = painting.at(place.map, texel);
      ASSERT_EQ(owner, 0u) << i << " lies on " << owner - 1;
      owner = i + 1;
    }
  }
  for (std::uint32_t i = 0; i < masks.size(); ++i)
    for (const ivec2 texel : placedTexels(masks[i], packing.places[i])) {
      const std::uint32_t other =
          painting.neighbour(packing.places[i].map, texel, settings.gap, i + 1);
      ASSERT_EQ(other, 0u) << i << " is too near to " << other - 1;
    }
}

TEST(PackMasks, KeepsChartsApart) {
  for (const int gap : {0, 1, 2, 5})
    for (const std::size_t count : {0u, 1u, 2u, 1500u}) {
      SCOPED_TRACE(count);
      const PackSettings settings{.side = 200, .gap = gap};
      const auto charts = someCharts(count, 199.f, 7 + static_cast<std::uint64_t>(gap));
      const auto result = packed(charts, settings);
      ASSERT_TRUE(result) << result.error().message;
      expectApart(result->packing, result->masks, settings);
      EXPECT_EQ(result->packing.maps == 0, count == 0);
    }
}

TEST(PackMasks, LaysPointsOfChartsOnTheirTexels) {
  const auto charts = someCharts(500, 100.f, 3);
  const auto result = packed(charts, {.side = 256});
  ASSERT_TRUE(result);
  std::array<int, 4> turns{};
  for (std::size_t i = 0; i < charts.size(); ++i) {
    const Place& place = result->packing.places[i];
    ++turns[static_cast<std::size_t>(place.turned) + 2 * static_cast<std::size_t>(place.reversed)];
    const auto texels = placedTexels(result->masks[i], place);
    for (const FlatTriangle& t : charts[i]) {
      const vec2 middle = (t[0] + t[1] + t[2]) / 3.f;
      const vec2 p = placedPoint(place, result->masks[i].size(), middle - result->least[i]);
      EXPECT_TRUE(std::ranges::any_of(texels, [&](ivec2 texel) {
        return glm::all(glm::lessThanEqual(glm::abs(p - (vec2(texel) + 0.5f)), vec2(0.501f)));
      })) << i;
    }
  }
  EXPECT_GT(std::ranges::min(turns), 10);
}

TEST(PackMasks, WholeMapsAndSingleTexels) {
  Chart whole, single;
  addRectangle(whole, vec2(0), vec2(128));
  addRectangle(single, vec2(0), vec2(1));
  std::vector<Chart> charts(3, whole);
  charts.resize(3 + 1600, single);
  const PackSettings settings{.side = 128, .gap = 2};
  const auto result = packed(charts, settings);
  ASSERT_TRUE(result);
  EXPECT_EQ(result->packing.maps, 4);  // 43 x 43 single ones fit
  expectApart(result->packing, result->masks, settings);
  EXPECT_EQ(occupancy(result->packing, result->masks, settings.side), 1.);
}

// Two triangles to a square, and squares into frames.
TEST(PackMasks, FillsWhatRectanglesLeaveEmpty) {
  std::vector<Chart> charts;
  for (int i = 0; i < 40; ++i) {
    charts.push_back({{vec2(0), vec2(100, 0), vec2(0, 100)}});
    Chart frame, square;
    addRectangle(frame, vec2(0), vec2(100, 5));
    addRectangle(frame, vec2(0, 95), vec2(100, 100));
    addRectangle(frame, vec2(0), vec2(5, 100));
    addRectangle(frame, vec2(95, 0), vec2(100, 100));
    addRectangle(square, vec2(0), vec2(86));
    charts.push_back(frame), charts.push_back(square);
  }
  const PackSettings settings{.side = 512, .gap = 2};
  const auto result = packed(charts, settings);
  ASSERT_TRUE(result);
  expectApart(result->packing, result->masks, settings);
  EXPECT_EQ(result->packing.maps, 3);  // the charts and their gaps are 2.5
  EXPECT_GT(occupancy(result->packing, result->masks, settings.side), 0.75);
  std::vector<ivec2> sizes;
  for (const TexelMask& mask : result->masks) sizes.push_back(mask.size());
  EXPECT_GT(pack(sizes, settings)->maps, 4);
}

TEST(PackMasks, FillsMaps) {
  const auto charts = someCharts(4000, 300.f, 4);
  const auto result = packed(charts, {.side = 512, .gap = 2});
  ASSERT_TRUE(result);
  EXPECT_GT(result->packing.maps, 4);
  EXPECT_GT(occupancy(result->packing, result->masks, 512), 0.8);
}

TEST(PackMasks, GivesTheSameForTheSame) {
  const auto charts = someCharts(1000, 100.f, 5);
  const auto first = packed(charts, {.side = 256}), second = packed(charts, {.side = 256});
  ASSERT_TRUE(first && second);
  for (std::size_t i = 0; i < charts.size(); ++i) {
    const Place &p = first->packing.places[i], &q = second->packing.places[i];
    EXPECT_EQ(p.map, q.map);
    EXPECT_EQ(p.corner, q.corner);
    EXPECT_EQ(p.turned, q.turned);
    EXPECT_EQ(p.reversed, q.reversed);
  }
}

TEST(PackMasks, SaysWhatDoesNotFit) {
  std::vector<Chart> charts(2);
  addRectangle(charts[0], vec2(0), vec2(10));
  addRectangle(charts[1], vec2(0), vec2(1e5f, 4e5f));
  const auto tooLarge = packed(charts, {.side = 200});
  ASSERT_FALSE(tooLarge);
  EXPECT_EQ(tooLarge.error().kind, ErrorKind::Input);
  EXPECT_THAT(tooLarge.error().message, HasSubstr("chart 1 has 100000 x 400000 texels"));
  EXPECT_THAT(tooLarge.error().message, HasSubstr("0.0005 of this one"));
  Chart whole;
  addRectangle(whole, vec2(0), vec2(100));
  const auto tooMany = packed(std::vector<Chart>(16, whole), {.side = 100, .mostMaps = 4});
  ASSERT_FALSE(tooMany);
  EXPECT_EQ(tooMany.error().kind, ErrorKind::Usage);
  EXPECT_EQ(tooMany.error().message,
            "16 charts need about 16 maps of 100 x 100 texels, and --most-maps allows 4");
}

}  // namespace
}  // namespace lucerna::bake
