#include "core/hash.hpp"

#include <cstring>

namespace lucerna {
namespace {

constexpr std::uint64_t kOffset = 14695981039346656037ull;
constexpr std::uint64_t kPrime = 1099511628211ull;

// The finaliser of MurmurHash3 (Appleby 2011): every input bit reaches every output bit.
std::uint64_t mixed(std::uint64_t h) {
  h = (h ^ (h >> 33)) * 0xff51afd7ed558ccdull;
  h = (h ^ (h >> 33)) * 0xc4ceb9fe1a85ec53ull;
  return h ^ (h >> 33);
}

}  // namespace

std::uint64_t hashBytes(std::span<const std::byte> bytes, std::uint64_t seed) {
  std::uint64_t h = kOffset ^ mixed(seed + bytes.size());
  const std::byte* at = bytes.data();
  std::size_t left = bytes.size();
  while (left > 0) {
    // Words of 8 bytes, the last one filled up with zeros (the size is already in the seed). The
    // rotation brings high bits down, which the multiplication alone never does.
    const std::size_t count = left < 8 ? left : 8;
    std::uint64_t word = 0;
    std::memcpy(&word, at, count);
    h = (h ^ word) * kPrime;
    h = (h << 29) | (h >> 35);
    at += count;
    left -= count;
  }
  return mixed(h);
}

std::uint64_t hashText(std::string_view text, std::uint64_t seed) {
  return hashBytes(std::as_bytes(std::span(text.data(), text.size())), seed);
}

std::uint64_t hashCombine(std::uint64_t a, std::uint64_t b) {
  return mixed(a * kPrime + mixed(b + kOffset));
}

}  // namespace lucerna
