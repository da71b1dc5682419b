// For tests: a second decoder of BC6H, slow and apart from the library's.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <bitset>
#include <string>
#include <vector>

#include "image/bc6h.hpp"

namespace lucerna {

// A decoder after the tables of the Direct3D documentation, which list the place of each bit of an
// endpoint where bc6h_format.cpp lists the bits in the order of their places: slow and separate.
struct SlowMode {
  unsigned number;
  int regions, bits;
  std::array<int, 3> deltas;  // 0: not transformed
  // Red, green, blue of the four endpoints: the block's bits from the lowest of the value on;
  // "5-14" stands for ten of them in a row.
  std::array<std::array<const char*, 4>, 3> places;
};

inline const std::vector<SlowMode> kSlowModes = {
    {0b00,
     2,
     10,
     {5, 5, 5},
     {{{"5-14", "35-39", "65-69", "71-75"},
       {"15-24", "45-49", "41-44 2", "51-54 40"},
       {"25-34", "55-59", "61-64 3", "50 60 70 76 4"}}}},
    {0b01,
     2,
     7,
     {6, 6, 6},
     {{{"5-11", "35-40", "65-70", "71-76"},
       {"15-21", "45-50", "41-44 24 2", "51-54 3 4"},
       {"25-31", "55-60", "61-64 14 22", "12 13 23 32 34 33"}}}},
    {0b00010,
     2,
     11,
     {5, 4, 4},
     {{{"5-14 40", "35-39", "65-69", "71-75"},
       {"15-24 49", "45-48", "41-44", "51-54"},
       {"25-34 59", "55-58", "61-64", "50 60 70 76"}}}},
    {0b00110,
     2,
     11,
     {4, 5, 4},
     {{{"5-14 39", "35-38", "65-68", "71-74"},
       {"15-24 50", "45-49", "41-44 75", "51-54 40"},
       {"25-34 59", "55-58", "61-64", "69 60 70 76"}}}},
    {0b01010,
     2,
     11,
     {4, 4, 5},
     {{{"5-14 39", "35-38", "65-68", "71-74"},
       {"15-24 49", "45-48", "41-44", "51-54"},
       {"25-34 60", "55-59", "61-64 40", "50 69 70 76 75"}}}},
    {0b01110,
     2,
     9,
     {5, 5, 5},
     {{{"5-13", "35-39", "65-69", "71-75"},
       {"15-23", "45-49", "41-44 24", "51-54 40"},
       {"25-33", "55-59", "61-64 14", "50 60 70 76 34"}}}},
    {0b10010,
     2,
     8,
     {6, 5, 5},
     {{{"5-12", "35-40", "65-70", "71-76"},
       {"15-22", "45-49", "41-44 24", "51-54 13"},
       {"25-32", "55-59", "61-64 14", "50 60 23 33 34"}}}},
    {0b10110,
     2,
     8,
     {5, 6, 5},
     {{{"5-12", "35-39", "65-69", "71-75"},
       {"15-22", "45-50", "41-44 24 23", "51-54 40 33"},
       {"25-32", "55-59", "61-64 14", "13 60 70 76 34"}}}},
    {0b11010,
     2,
     8,
     {5, 5, 6},
     {{{"5-12", "35-39", "65-69", "71-75"},
       {"15-22", "45-49", "41-44 24", "51-54 40"},
       {"25-32", "55-60", "61-64 14 23", "50 13 70 76 34 33"}}}},
    {0b11110,
     2,
     6,
     {0, 0, 0},
     {{{"5-10", "35-40", "65-70", "71-76"},
       {"15-20", "45-50", "41-44 24 21", "51-54 11 31"},
       {"25-30", "55-60", "61-64 14 22", "12 13 23 32 34 33"}}}},
    {0b00011,
     1,
     10,
     {0, 0, 0},
     {{{"5-14", "35-44", "", ""}, {"15-24", "45-54", "", ""}, {"25-34", "55-64", "", ""}}}},
    {0b00111,
     1,
     11,
     {9, 9, 9},
     {{{"5-14 44", "35-43", "", ""},
       {"15-24 54", "45-53", "", ""},
       {"25-34 64", "55-63", "", ""}}}},
    {0b01011,
     1,
     12,
     {8, 8, 8},
     {{{"5-14 44 43", "35-42", "", ""},
       {"15-24 54 53", "45-52", "", ""},
       {"25-34 64 63", "55-62", "", ""}}}},
    {0b01111,
     1,
     16,
     {4, 4, 4},
     {{{"5-14 44 43 42 41 40 39", "35-38", "", ""},
       {"15-24 54 53 52 51 50 49", "45-48", "", ""},
       {"25-34 64 63 62 61 60 59", "55-58", "", ""}}}}};

// Texels of region 1, and the anchor there.
struct SlowPartition {
  const char* picture;
  int anchor;
};
inline const std::vector<SlowPartition> kSlowPartitions = {
    {"..## ..## ..## ..##", 15}, {"...# ...# ...# ...#", 15}, {".### .### .### .###", 15},
    {"...# ..## ..## .###", 15}, {".... ...# ...# ..##", 15}, {"..## .### .### ####", 15},
    {"...# ..## .### ####", 15}, {".... ...# ..## .###", 15}, {".... .... ...# ..##", 15},
    {"..## .### #### ####", 15}, {".... ...# .### ####", 15}, {".... .... ...# .###", 15},
    {"...# .### #### ####", 15}, {".... .... #### ####", 15}, {".... #### #### ####", 15},
    {".... .... .... ####", 15}, {".... #... ###. ####", 15}, {".### ...# .... ....", 2},
    {".... .... #... ###.", 8},  {".### ..## ...# ....", 2},  {"..## ...# .... ....", 2},
    {".... #... ##.. ###.", 8},  {".... .... #... ##..", 8},  {".### ..## ..## ...#", 15},
    {"..## ...# ...# ....", 2},  {".... #... #... ##..", 8},  {".##. .##. .##. .##.", 2},
    {"..## .##. .##. ##..", 2},  {"...# .### ###. #...", 8},  {".... #### #### ....", 8},
    {".### ...# #... ###.", 2},  {"..## #..# #..# ##..", 2}};

using BlockBits = std::bitset<128>;

inline BlockBits bitsOf(const Bc6hBlock& block) {
  BlockBits bits;
  for (std::size_t i = 0; i < 128; ++i)
    bits[i] = (std::to_integer<unsigned>(block[i / 8]) >> i % 8 & 1) != 0;
  return bits;
}

inline std::vector<std::size_t> placesOf(const std::string& text) {
  std::vector<std::size_t> places;
  std::size_t at = 0;
  const auto number = [&] {
    std::size_t length = 0;
    const std::size_t value = std::stoul(text.substr(at), &length);
    at += length;
    return value;
  };
  while (at < text.size()) {
    const std::size_t first = number();
    std::size_t last = first;
    if (at < text.size() && text[at] == '-') ++at, last = number();
    for (std::size_t place = first; place <= last; ++place) places.push_back(place);
    while (at < text.size() && text[at] == ' ') ++at;
  }
  return places;
}

inline long valueAt(const BlockBits& bits, const std::vector<std::size_t>& places) {
  long value = 0;
  for (std::size_t i = 0; i < places.size(); ++i) value += long{bits[places[i]]} << i;
  return value;
}

inline const SlowMode* slowModeOf(const BlockBits& bits) {
  const unsigned two = bits[0] + 2u * bits[1],
                 five = two + 4u * bits[2] + 8u * bits[3] + 16u * bits[4];
  for (const SlowMode& mode : kSlowModes)
    if (mode.number == (two < 2 ? two : five)) return &mode;
  return nullptr;
}

// A number of `count` bits in two's complement.
inline long twosComplement(long value, int count) {
  return value >= 1L << (count - 1) ? value - (1L << count) : value;
}

inline long slowEndpoint(const BlockBits& bits, const SlowMode& mode, std::size_t channel,
                         std::size_t endpoint) {
  long value = valueAt(bits, placesOf(mode.places[channel][endpoint]));
  if (const int delta = mode.deltas[channel]; delta > 0 && endpoint > 0) {
    value = twosComplement(value, delta) + valueAt(bits, placesOf(mode.places[channel][0]));
    const long range = 1L << mode.bits;
    value = (value % range + range) % range;
  }
  const long largest = (1L << mode.bits) - 1;
  if (mode.bits == 16 || value == 0) return value;
  if (value == largest) return 65535;
  return (value * 32768 + 16384) / (1L << (mode.bits - 1));
}

inline Bc6hTexels slowDecode(const Bc6hBlock& block) {
  const BlockBits bits = bitsOf(block);
  const SlowMode* mode = slowModeOf(bits);
  if (!mode) return {};
  std::string picture(16, '.');
  int anchor = 0;
  if (mode->regions == 2) {
    const SlowPartition& partition =
        kSlowPartitions[static_cast<std::size_t>(valueAt(bits, placesOf("77-81")))];
    picture = partition.picture;
    std::erase(picture, ' ');
    anchor = partition.anchor;
  }
  const std::vector<long> weights =
      mode->regions == 2
          ? std::vector<long>{0, 9, 18, 27, 37, 46, 55, 64}
          : std::vector<long>{0, 4, 9, 13, 17, 21, 26, 30, 34, 38, 43, 47, 51, 55, 60, 64};
  Bc6hTexels texels;
  std::size_t at = mode->regions == 2 ? 82 : 65;
  for (int t = 0; t < 16; ++t) {
    const int count = (mode->regions == 2 ? 3 : 4) - (t == 0 || t == anchor ? 1 : 0);
    std::size_t index = 0;
    for (int i = 0; i < count; ++i) index += std::size_t{bits[at++]} << i;
    const std::size_t region = picture[t] == '#' ? 1 : 0;
    for (std::size_t c = 0; c < 3; ++c) {
      const long mixed = (slowEndpoint(bits, *mode, c, 2 * region) * (64 - weights[index]) +
                          slowEndpoint(bits, *mode, c, 2 * region + 1) * weights[index] + 32) /
                         64;
      texels[t][c] = static_cast<std::uint16_t>(mixed * 31 / 64);
    }
  }
  EXPECT_EQ(at, 128u);
  return texels;
}

}  // namespace lucerna
