// What a block of BC6H holds, for bc6h.cpp and bc6h_encode.cpp. Private to this folder. Facts of
// ARB_texture_compression_bptc and of the Khronos Data Format Specification, "BPTC".
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace lucerna::bc6h {

inline constexpr int kTexels = 16, kModes = 14, kPartitions = 32;

struct Mode {
  int number;                    // as the block's first two or five bits say it
  int regions;                   // 1, or 2 as one of the partitions cuts the block
  int endpointBits;              // of each channel
  std::array<int, 3> deltaBits;  // of red, green, blue in endpoints 1 to 3
  bool transformed;              // these are signed offsets from endpoint 0
};
extern const std::array<Mode, kModes> kModeTable;

// Bit t of a mask: texel t, counted row by row, lies in region 1.
extern const std::array<std::uint16_t, kPartitions> kPartitionMasks;
// The texel of region 1 whose index has its highest bit left out, being 0; of region 0 it is texel
// 0.
extern const std::array<std::uint8_t, kPartitions> kAnchors;

// Of index i: how much of the second endpoint there is, of 64.
inline constexpr std::array<int, 8> kWeights3 = {0, 9, 18, 27, 37, 46, 55, 64};
inline constexpr std::array<int, 16> kWeights4 = {0,  4,  9,  13, 17, 21, 26, 30,
                                                  34, 38, 43, 47, 51, 55, 60, 64};
// For blocks of one region 16, of two 8.
std::span<const int> weightsOf(int regions);

// A block taken apart. Endpoints 0 and 1 are region 0's, 2 and 3 region 1's, in `endpointBits`
// without any transform: what a decoder has once it added endpoint 0.
struct Fields {
  int mode = 0;  // in kModeTable
  int partition = 0;
  std::array<std::array<int, 3>, 4> endpoints = {};
  std::array<std::uint8_t, kTexels> indices = {};

  int regionOf(int texel) const {
    return kModeTable[mode].regions == 2 ? kPartitionMasks[partition] >> texel & 1 : 0;
  }
};

// Of the four reserved modes nothing.
std::optional<Fields> unpack(std::span<const std::byte, 16> block);
// The fields must fit their mode: see fits(), and anchors with a highest bit of 0.
std::array<std::byte, 16> pack(const Fields& fields);

// Whether the offsets from endpoint 0 fit their bits.
bool fits(const Mode& mode, const std::array<std::array<int, 3>, 4>& endpoints);

// From an endpoint's bits to 0 .. 0xffff, the scale on which colours are mixed.
constexpr int unquantized(int value, int bits) {
  if (bits >= 15 || value == 0) return value;
  if (value == (1 << bits) - 1) return 0xffff;
  return ((value << 15) + 0x4000) >> (bits - 1);
}
// A mixture, as half bits: at most 0x7bff, the largest there is.
constexpr std::uint16_t halfOf(int first, int second, int weight) {
  const int mixed = (first * (64 - weight) + second * weight + 32) >> 6;
  return static_cast<std::uint16_t>(mixed * 31 >> 6);
}

}  // namespace lucerna::bc6h
