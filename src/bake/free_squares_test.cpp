// Maps whose texels are tried one by one.
#include "bake/free_squares.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

#include "core/random.hpp"

namespace lucerna::bake {
namespace {

// An L, or a rectangle where the notch is as large as it; each row from 0 to somewhere.
TexelMask someShape(Random& random, int most) {
  const auto upTo = [&](int limit) {
    return 1 + static_cast<int>(random.below(static_cast<std::uint32_t>(limit)));
  };
  const ivec2 size(upTo(most), upTo(most));
  const int notchY = upTo(size.y), notchX = upTo(size.x);
  TexelMask mask(size);
  for (int y = 0; y < size.y; ++y) setRun(mask.row(y), 0, y < notchY ? size.x : notchX);
  return mask;
}

// A map of bytes, and every place tried from below and from the left.
class Slow {
 public:
  Slow(int side, int gap)
      : side_(side), gap_(gap), taken_(static_cast<std::size_t>(std::ptrdiff_t{side} * side)) {}

  std::optional<ivec2> find(const TexelMask& mask, int fromRow) {
    for (int y = fromRow; y + mask.size().y <= side_; ++y)
      for (int x = 0; x + mask.size().x <= side_; ++x)
        if (fits(mask, {x, y})) return ivec2(x, y);
    return std::nullopt;
  }
  void take(const TexelMask& mask, ivec2 place) {
    for (int y = 0; y < mask.size().y; ++y)
      for (int x = 0; x < mask.size().x; ++x)
        if (mask.at(x, y)) takeAround(place + ivec2(x, y));
  }

 private:
  char& at(int x, int y) { return taken_[static_cast<std::size_t>(std::ptrdiff_t{y} * side_ + x)]; }
  bool fits(const TexelMask& mask, ivec2 place) {
    for (int y = 0; y < mask.size().y; ++y)
      for (int x = 0; x < mask.size().x; ++x)
        if (mask.at(x, y) && at(place.x + x, place.y + y) != 0) return false;
    return true;
  }
  void takeAround(ivec2 texel) {
    for (int y = std::max(texel.y - gap_, 0); y <= std::min(texel.y + gap_, side_ - 1); ++y)
      for (int x = std::max(texel.x - gap_, 0); x <= std::min(texel.x + gap_, side_ - 1); ++x)
        at(x, y) = 1;
  }

  int side_, gap_;
  std::vector<char> taken_;
};

TEST(FreeSquares, FindsTheLowestPlaceThenTheLeftmost) {
  Random random(1);
  for (const int side : {1, 5, 64, 150})
    for (const int gap : {0, 1, 3}) {
      FreeSquares map(side, gap);
      Slow slow(side, gap);
      for (int i = 0; i < 60; ++i) {
        const TexelMask mask = someShape(random, i < 3 ? side : side / 5 + 1);
        const std::vector<Square> squares = squaresOf(mask);
        const int fromRow = i % 4 == 0 ? side / 3 : 0;
        const auto place = map.find(squares, mask.size(), fromRow, side - mask.size().y + 1);
        ASSERT_EQ(place, slow.find(mask, fromRow))
            << "side " << side << ", gap " << gap << ": " << i;
        if (!place) continue;
        map.take(squares, mask.size(), *place);
        slow.take(mask, *place);
      }
    }
}

TEST(FreeSquares, StopsAtTheLastRow) {
  FreeSquares map(10, 0);
  const std::vector<Square> one{{}};
  EXPECT_TRUE(map.find(one, ivec2(1), 9, 10));
  for (int x = 0; x < 10; ++x) map.take(one, ivec2(1), {x, 2});
  EXPECT_FALSE(map.find(one, ivec2(1), 2, 3));
  EXPECT_EQ(map.find(one, ivec2(1), 2, 4), ivec2(0, 3));
}

TEST(FreeSquares, KeepsTheWholeRectangleInside) {
  FreeSquares map(4, 0);
  const std::vector<Square> one{{}};
  for (const ivec2 expected : {ivec2(0), ivec2(1, 0), ivec2(0, 1)}) {
    const auto place = map.find(one, ivec2(3, 2), 0, 3);  // all but one texel are empty
    ASSERT_EQ(place, expected);
    map.take(one, ivec2(3, 2), *place);
  }
}

// More than 64 words to a row.
TEST(FreeSquares, MapsMayBeWide) {
  constexpr int kSide = 5000;
  FreeSquares map(kSide, 2);
  TexelMask mask({1200, 1});
  setRun(mask.row(0), 0, 1200);
  const std::vector<Square> squares = squaresOf(mask);
  for (const ivec2 expected :
       {ivec2(0), ivec2(1202, 0), ivec2(2404, 0), ivec2(3606, 0), ivec2(0, 3)}) {
    const auto place = map.find(squares, mask.size(), 0, kSide);
    ASSERT_EQ(place, expected);
    map.take(squares, mask.size(), *place);
  }
  const std::vector<Square> one{{}};
  EXPECT_EQ(map.find(one, ivec2(1), 0, kSide), ivec2(4808, 0));
}

}  // namespace
}  // namespace lucerna::bake
