// A fast non-cryptographic 64-bit hash (FNV-1a over 8-byte words with a final mix). The same bytes
// give the same value on every machine of the same byte order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace lucerna {

std::uint64_t hashBytes(std::span<const std::byte> bytes, std::uint64_t seed = 0);
std::uint64_t hashText(std::string_view text, std::uint64_t seed = 0);
std::uint64_t hashCombine(std::uint64_t a, std::uint64_t b);

}  // namespace lucerna
