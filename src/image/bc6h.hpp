// Linear colour in BC6H (unsigned): 16 bytes for each block of 4x4 texels, 8 bits a texel
// (ARB_texture_compression_bptc; VkFormat BC6H_UFLOAT_BLOCK).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/file.hpp"
#include "image/image.hpp"

namespace lucerna {

inline constexpr float kLargestBc6h = kLargestHalf;

using Bc6hBlock = std::array<std::byte, 16>;
// Row by row: red, green, blue as half bits of numbers from 0 to kLargestBc6h (0x7bff).
using Bc6hTexels = std::array<std::array<std::uint16_t, 3>, 16>;

// All 14 modes, bit for bit as the specification has it; blocks of the reserved modes are black.
Bc6hTexels decodeBc6hBlock(std::span<const std::byte, 16> block);

// Looks for a small sum of (error of a channel / (the texel's largest channel + 1/1024 of the
// block's largest))^2 over linear values. Texels that are all alike come back exactly. The same
// texels give the same block everywhere.
Bc6hBlock encodeBc6hBlock(const Bc6hTexels& texels);

// Of an image of that size; blocks lie row by row.
constexpr std::uint64_t bc6hBytes(int width, int height) {
  return (std::uint64_t(width) + 3) / 4 * ((std::uint64_t(height) + 3) / 4) * 16;
}
// image: F32 or Half with 3 or 4 channels; the fourth is left out. Of what is not a positive number
// 0 is taken, of what is too large the largest. Blocks that stick out repeat the last texels.
Bytes encodeBc6h(const Image& image);
// blocks: bc6hBytes() of them. F32, red, green, blue.
Image decodeBc6h(std::span<const std::byte> blocks, int width, int height);

}  // namespace lucerna
