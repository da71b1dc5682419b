// Shapes put together again from their squares.
#include "bake/mask_squares.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <span>
#include <vector>

#include "core/random.hpp"

namespace lucerna::bake {
namespace {

// Discs, with holes and single texels in between.
TexelMask someMask(Random& random, ivec2 size) {
  TexelMask mask(size);
  const auto paint = [&](bool set, float most) {
    const vec2 centre(random.uniform(0.f, static_cast<float>(size.x)),
                      random.uniform(0.f, static_cast<float>(size.y)));
    const float radius = random.uniform(0.f, most);
    for (int y = 0; y < size.y; ++y)
      for (int x = 0; x < size.x; ++x)
        if (glm::distance(vec2(x, y), centre) <= radius)
          set ? setRun(mask.row(y), x, x + 1) : clearRun(mask.row(y), x, x + 1);
  };
  for (int i = 0; i < 4; ++i) paint(true, 100.f);
  for (int i = 0; i < 8; ++i) paint(i % 2 == 0, 20.f);
  return mask;
}

TexelMask unionOf(std::span<const Square> squares, ivec2 size) {
  TexelMask mask(size);
  for (const Square& square : squares) {
    EXPECT_GE(std::min(square.corner.x, square.corner.y), 0);
    EXPECT_LE(square.corner.x + square.side(), size.x);
    EXPECT_LE(square.corner.y + square.side(), size.y);
    for (int y = square.corner.y; y < square.corner.y + square.side(); ++y)
      setRun(mask.row(y), square.corner.x, square.corner.x + square.side());
  }
  return mask;
}

TEST(MaskSquares, AreTheMask) {
  Random random(1);
  for (const ivec2 size : {ivec2(1), ivec2(63, 5), ivec2(64), ivec2(65, 130), ivec2(200, 150)})
    for (int i = 0; i < 20; ++i) {
      const TexelMask mask = someMask(random, size);
      const std::vector<Square> squares = squaresOf(mask);
      EXPECT_TRUE(unionOf(squares, size) == mask) << size.x << " x " << size.y;
      EXPECT_TRUE(std::ranges::is_sorted(squares, std::ranges::greater{}, &Square::level));
    }
}

TEST(MaskSquares, AreFewOfARectangle) {
  const auto countOf = [](ivec2 size) {
    TexelMask mask(size);
    for (int y = 0; y < size.y; ++y) setRun(mask.row(y), 0, size.x);
    return squaresOf(mask).size();
  };
  EXPECT_EQ(countOf(ivec2(64)), 1u);
  EXPECT_EQ(countOf(ivec2(65, 64)), 2u);
  EXPECT_EQ(countOf(ivec2(100, 200)), 8u);
  EXPECT_EQ(countOf(ivec2(33, 40)), 4u);
  EXPECT_EQ(countOf(ivec2(7, 4)), 2u);
}

}  // namespace
}  // namespace lucerna::bake
