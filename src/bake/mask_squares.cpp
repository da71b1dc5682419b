#include "bake/mask_squares.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace lucerna::bake {
namespace {

// Word `word` of a row, moved by `by` texels towards the left or the right; by is less than 64.
std::uint64_t fromRight(const std::uint64_t* row, int word, int words, int by) {
  const std::uint64_t next = word + 1 < words ? row[word + 1] : 0;
  return row[word] >> by | next << 1 << (63 - by);
}
std::uint64_t fromLeft(const std::uint64_t* row, int word, int by) {
  const std::uint64_t last = word > 0 ? row[word - 1] : 0;
  return row[word] << by | last >> 1 >> (63 - by);
}

// The corners of squares of twice the side, from those of the squares with this side.
TexelMask doubled(const TexelMask& corners, int side) {
  TexelMask result(corners.size());
  for (int y = 0; y + side < corners.size().y; ++y) {
    const std::uint64_t *const low = corners.row(y), *const high = corners.row(y + side);
    const int words = corners.wordsPerRow();
    for (int word = 0; word < words; ++word)
      result.row(y)[word] = low[word] & fromRight(low, word, words, side) & high[word] &
                            fromRight(high, word, words, side);
  }
  return result;
}

// The texels of squares at these corners.
TexelMask filled(TexelMask corners, int side) {
  for (int by = 1; by < side; by *= 2) {
    for (int y = 0; y < corners.size().y; ++y)
      for (int word = corners.wordsPerRow() - 1; word >= 0; --word)
        corners.row(y)[word] |= fromLeft(corners.row(y), word, by);
    for (int y = corners.size().y - 1; y >= by; --y)
      for (int word = 0; word < corners.wordsPerRow(); ++word)
        corners.row(y)[word] |= corners.row(y - by)[word];
  }
  return corners;
}

// The last bit of the row in [x - side + 1, x], or -1. side is at most 64.
int lastBit(const TexelMask& mask, int y, int x, int side) {
  const std::uint64_t window = fromLeft(mask.row(y), x / 64, 63 - x % 64) >> (64 - side);
  return window == 0 ? -1 : x - std::countl_zero(window << (64 - side));
}

// A corner of a square that has this texel, and as many as can be of those above and to the right.
ivec2 cornerAround(const TexelMask& corners, ivec2 texel, int side) {
  for (int y = texel.y;; --y)
    if (const int x = lastBit(corners, y, texel.x, side); x >= 0) return {x, y};
}

class Cover {
 public:
  explicit Cover(const TexelMask& mask) : open_(mask) {}

  void addSquares(const TexelMask& corners, int level) {
    const TexelMask reached = filled(corners, 1 << level);
    const std::size_t first = squares_.size();
    for (int y = 0; y < open_.size().y; ++y)
      for (int word = 0; word < open_.wordsPerRow(); ++word)
        while (const std::uint64_t bits = open_.row(y)[word] & reached.row(y)[word]) {
          const ivec2 texel(64 * word + std::countr_zero(bits), y);
          add({cornerAround(corners, texel, 1 << level), level});
        }
    scatter(first);
  }
  std::vector<Square> take() { return std::move(squares_); }

 private:
  void add(const Square& square) {
    squares_.push_back(square);
    for (int y = square.corner.y; y < square.corner.y + square.side(); ++y)
      clearRun(open_.row(y), square.corner.x, square.corner.x + square.side());
  }

  // In steps of the golden section.
  void scatter(std::size_t first) {
    const std::vector<Square> sorted(squares_.begin() + static_cast<std::ptrdiff_t>(first),
                                     squares_.end());
    std::vector<std::pair<std::uint32_t, std::size_t>> order(sorted.size());
    for (std::size_t i = 0; i < order.size(); ++i)
      order[i] = {static_cast<std::uint32_t>(i) * 2654435769u, i};
    std::ranges::sort(order);
    for (std::size_t i = 0; i < order.size(); ++i) squares_[first + i] = sorted[order[i].second];
  }

  TexelMask open_;  // texels that no square has yet
  std::vector<Square> squares_;
};

}  // namespace

std::vector<Square> squaresOf(const TexelMask& mask) {
  std::vector<TexelMask> corners{mask};
  const int shortest = std::min(mask.size().x, mask.size().y);
  for (int level = 1; level < kSquareLevels && 1 << level <= shortest; ++level)
    corners.push_back(doubled(corners.back(), 1 << (level - 1)));
  Cover cover(mask);
  for (int level = static_cast<int>(corners.size()) - 1; level >= 0; --level)
    cover.addSquares(corners[static_cast<std::size_t>(level)], level);
  return cover.take();
}

}  // namespace lucerna::bake
