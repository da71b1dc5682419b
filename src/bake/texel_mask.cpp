#include "bake/texel_mask.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>

namespace lucerna::bake {
namespace {

// Calls apply(word, bits) for the words of the run [begin, end).
template <typename Apply>
void forWords(std::uint64_t* words, int begin, int end, const Apply& apply) {
  const int first = begin / 64, last = (end - 1) / 64;
  const std::uint64_t all = ~std::uint64_t{0}, left = all << (begin % 64),
                      right = all >> (63 - (end - 1) % 64);
  if (first == last) {
    apply(words[first], left & right);
    return;
  }
  apply(words[first], left);
  for (int word = first + 1; word < last; ++word) apply(words[word], all);
  apply(words[last], right);
}

}  // namespace

void setRun(std::uint64_t* words, int begin, int end) {
  forWords(words, begin, end, [](std::uint64_t& word, std::uint64_t bits) { word |= bits; });
}

void clearRun(std::uint64_t* words, int begin, int end) {
  forWords(words, begin, end, [](std::uint64_t& word, std::uint64_t bits) { word &= ~bits; });
}

std::int64_t TexelMask::count() const {
  std::int64_t sum = 0;
  for (const std::uint64_t word : words_) sum += std::popcount(word);
  return sum;
}

std::strong_ordering TexelMask::operator<=>(const TexelMask& other) const {
  if (const auto widths = size_.x <=> other.size_.x; widths != 0) return widths;
  if (const auto heights = size_.y <=> other.size_.y; heights != 0) return heights;
  return words_ <=> other.words_;
}

}  // namespace lucerna::bake
