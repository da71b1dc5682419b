// A shape made of texels.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/math/math.hpp"

namespace lucerna::bake {

// Of a row: the bits from `begin` to before `end`, which is larger.
void setRun(std::uint64_t* words, int begin, int end);
void clearRun(std::uint64_t* words, int begin, int end);

// One bit a texel, in rows of 64-bit words; the lowest bit is the one farthest to the left. Bits
// past the right end of a row are 0.
class TexelMask {
 public:
  TexelMask() = default;
  explicit TexelMask(ivec2 size)
      : size_(size),
        wordsPerRow_((size.x + 63) / 64),
        words_(static_cast<std::size_t>(wordsPerRow_) * static_cast<std::size_t>(size.y)) {}

  ivec2 size() const { return size_; }
  int wordsPerRow() const { return wordsPerRow_; }
  const std::uint64_t* row(int y) const { return words_.data() + std::ptrdiff_t{y} * wordsPerRow_; }
  std::uint64_t* row(int y) { return words_.data() + std::ptrdiff_t{y} * wordsPerRow_; }

  bool at(int x, int y) const { return (row(y)[x / 64] >> (x % 64) & 1) != 0; }
  std::int64_t count() const;

  // An order of some kind.
  std::strong_ordering operator<=>(const TexelMask& other) const;
  bool operator==(const TexelMask& other) const { return (*this <=> other) == 0; }

 private:
  ivec2 size_{0};
  int wordsPerRow_ = 0;
  std::vector<std::uint64_t> words_;
};

}  // namespace lucerna::bake
