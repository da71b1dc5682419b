// The free texels of a map, and of each power of two the free squares with that side: where a shape
// made of squares fits, 64 places are tried at once, and rows and words without a free square of
// the shape's largest side are passed over.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "bake/mask_squares.hpp"
#include "core/math/math.hpp"

namespace lucerna::bake {

class FreeSquares {
 public:
  // All of a map of side x side texels is free.
  FreeSquares(int side, int gap);

  // squares: a shape, as squaresOf() gives it, in a rectangle of that size. The lowest place for it
  // of those in rows from fromRow to before endRow, of those the one farthest to the left: where
  // the rectangle's least texel comes to lie. endRow: at most side - size.y + 1.
  std::optional<ivec2> find(std::span<const Square> squares, ivec2 size, int fromRow,
                            int endRow) const;

  // The texels of the shape at that place are free no more, nor are those that have less than the
  // gap between themselves and one of these, along x and along y.
  void take(std::span<const Square> squares, ivec2 size, ivec2 place);

 private:
  const std::uint64_t* row(int level, int y) const;
  std::uint64_t* row(int level, int y);
  std::uint64_t groupsOf(int level, int y) const;
  std::uint64_t& groupsOf(int level, int y);
  std::uint64_t cornersAt(int level, int y, int word) const;
  std::uint64_t groupsThatMayFit(std::span<const Square> squares, int y) const;
  std::uint64_t placesThatFit(std::span<const Square> squares, int y, int word) const;
  void updateLevel(int level, ivec2 low, ivec2 high);
  void updateRow(int level, int y, int firstWord, int lastWord);
  void resetGroups(int level, int y, int firstWord, int lastWord);

  int side_, gap_;
  int rows_;            // side and a margin of the gap at each end, in which nothing is free
  int words_, stride_;  // of a row; and with one word more, which is 0
  int wordsPerGroup_;   // a power of two; 64 groups are enough for a row
  int texelShift_;      // log2 of the texels of a group
  std::vector<std::uint64_t> corners_;  // of free squares, bits in rows, for each level
  std::vector<std::uint64_t> groups_;   // of words that are not 0, for each level and row
};

}  // namespace lucerna::bake
