#include "bake/free_squares.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>

namespace lucerna::bake {
namespace {

std::uint64_t shifted(const std::uint64_t* words, unsigned by) {
  return words[0] >> by | words[1] << 1 << (63 - by);
}

// Of a shape: those that choose rows and words.
constexpr std::size_t kFilterSquares = 4;

}  // namespace

FreeSquares::FreeSquares(int side, int gap)
    : side_(side),
      gap_(gap),
      rows_(side + 2 * gap),
      words_((rows_ + 63) / 64),
      stride_(words_ + 1),
      wordsPerGroup_(static_cast<int>(std::bit_ceil(static_cast<unsigned>(words_ + 63) / 64))),
      texelShift_(std::countr_zero(static_cast<unsigned>(64 * wordsPerGroup_))) {
  const auto rows = static_cast<std::size_t>(kSquareLevels) * static_cast<std::size_t>(rows_);
  corners_.resize(rows * static_cast<std::size_t>(stride_));
  groups_.resize(rows);
  for (int y = gap; y < gap + side; ++y) setRun(row(0, y), gap, gap + side);
  for (int level = 0; level < kSquareLevels; ++level)
    for (int y = 0; y + (1 << level) <= rows_; ++y) {
      if (level > 0)
        for (int word = 0; word < words_; ++word) row(level, y)[word] = cornersAt(level, y, word);
      resetGroups(level, y, 0, words_ - 1);
    }
}

const std::uint64_t* FreeSquares::row(int level, int y) const {
  return corners_.data() + (std::ptrdiff_t{level} * rows_ + y) * stride_;
}
std::uint64_t* FreeSquares::row(int level, int y) {
  return corners_.data() + (std::ptrdiff_t{level} * rows_ + y) * stride_;
}
std::uint64_t FreeSquares::groupsOf(int level, int y) const {
  return groups_[static_cast<std::size_t>(std::ptrdiff_t{level} * rows_ + y)];
}
std::uint64_t& FreeSquares::groupsOf(int level, int y) {
  return groups_[static_cast<std::size_t>(std::ptrdiff_t{level} * rows_ + y)];
}

std::uint64_t FreeSquares::cornersAt(int level, int y, int word) const {
  const int half = 1 << (level - 1);
  const std::uint64_t *const low = row(level - 1, y) + word, *const high =
                                                                 row(level - 1, y + half) + word;
  return *low & shifted(low, half) & *high & shifted(high, half);
}

void FreeSquares::resetGroups(int level, int y, int firstWord, int lastWord) {
  const std::uint64_t* const words = row(level, y);
  for (int group = firstWord / wordsPerGroup_; group <= lastWord / wordsPerGroup_; ++group) {
    const int first = group * wordsPerGroup_, end = std::min(first + wordsPerGroup_, words_);
    const bool any = std::any_of(words + first, words + end, [](auto word) { return word != 0; });
    const std::uint64_t bit = std::uint64_t{1} << group;
    groupsOf(level, y) = any ? groupsOf(level, y) | bit : groupsOf(level, y) & ~bit;
  }
}

std::uint64_t FreeSquares::groupsThatMayFit(std::span<const Square> squares, int y) const {
  std::uint64_t groups = ~std::uint64_t{0};
  for (const Square& square : squares.first(std::min(squares.size(), kFilterSquares))) {
    const std::uint64_t read = groupsOf(square.level, y + square.corner.y) >>
                               (static_cast<unsigned>(square.corner.x) >> texelShift_);
    groups &= read | read >> 1;
    if (groups == 0) break;
  }
  return groups;
}

std::uint64_t FreeSquares::placesThatFit(std::span<const Square> squares, int y, int word) const {
  const std::uint64_t* const base = corners_.data() + std::ptrdiff_t{y} * stride_ + word;
  std::uint64_t places = ~std::uint64_t{0};
  for (const auto& [corner, level] : squares) {
    const auto x = static_cast<unsigned>(corner.x);
    places &=
        shifted(base + (std::ptrdiff_t{level} * rows_ + corner.y) * stride_ + (x >> 6), x & 63);
    if (places == 0) break;
  }
  return places;
}

std::optional<ivec2> FreeSquares::find(std::span<const Square> squares, ivec2 size, int fromRow,
                                       int endRow) const {
  const int lastX = gap_ + side_ - size.x, words = lastX / 64 + 1;
  const std::uint64_t within = ~std::uint64_t{0} >> (63 - (words - 1) / wordsPerGroup_),
                      withinLast = ~std::uint64_t{0} >> (63 - lastX % 64);
  for (int y = gap_ + fromRow; y < gap_ + endRow; ++y)
    for (std::uint64_t groups = groupsThatMayFit(squares, y) & within; groups != 0;
         groups &= groups - 1) {
      const int first = std::countr_zero(groups) * wordsPerGroup_,
                end = std::min(first + wordsPerGroup_, words);
      for (int word = first; word < end; ++word) {
        std::uint64_t places = placesThatFit(squares, y, word);
        if (word == words - 1) places &= withinLast;
        if (places != 0) return ivec2(64 * word + std::countr_zero(places), y) - gap_;
      }
    }
  return std::nullopt;
}

void FreeSquares::take(std::span<const Square> squares, ivec2 size, ivec2 place) {
  for (const Square& square : squares) {
    const ivec2 low = place + square.corner, high = low + square.side() + 2 * gap_;
    for (int y = low.y; y < high.y; ++y) clearRun(row(0, y), low.x, high.x);
  }
  const ivec2 high = place + size + 2 * gap_;
  for (int y = place.y; y < high.y; ++y) resetGroups(0, y, place.x / 64, (high.x - 1) / 64);
  for (int level = 1; level < kSquareLevels; ++level) updateLevel(level, place, high);
}

void FreeSquares::updateLevel(int level, ivec2 low, ivec2 high) {
  const int side = 1 << level;
  const int firstWord = std::max(low.x - side + 1, 0) / 64, lastWord = (high.x - 1) / 64;
  const int end = std::min(high.y, rows_ - side + 1);
  for (int y = std::max(low.y - side + 1, 0); y < end; ++y)
    if (groupsOf(level, y) != 0) updateRow(level, y, firstWord, lastWord);
}

void FreeSquares::updateRow(int level, int y, int firstWord, int lastWord) {
  std::uint64_t* const words = row(level, y);
  bool emptied = false;
  for (int word = firstWord; word <= lastWord; ++word)
    if (words[word] != 0) {
      words[word] = cornersAt(level, y, word);
      emptied |= words[word] == 0;
    }
  if (emptied) resetGroups(level, y, firstWord, lastWord);
}

}  // namespace lucerna::bake
