#include "image/bc6h_format.hpp"

#include <string_view>

#include "core/check.hpp"

namespace lucerna::bc6h {

const std::array<Mode, kModes> kModeTable = {{{0, 2, 10, {5, 5, 5}, true},
                                              {1, 2, 7, {6, 6, 6}, true},
                                              {2, 2, 11, {5, 4, 4}, true},
                                              {6, 2, 11, {4, 5, 4}, true},
                                              {10, 2, 11, {4, 4, 5}, true},
                                              {14, 2, 9, {5, 5, 5}, true},
                                              {18, 2, 8, {6, 5, 5}, true},
                                              {22, 2, 8, {5, 6, 5}, true},
                                              {26, 2, 8, {5, 5, 6}, true},
                                              {30, 2, 6, {6, 6, 6}, false},
                                              {3, 1, 10, {10, 10, 10}, false},
                                              {7, 1, 11, {9, 9, 9}, true},
                                              {11, 1, 12, {8, 8, 8}, true},
                                              {15, 1, 16, {4, 4, 4}, true}}};

const std::array<std::uint16_t, kPartitions> kPartitionMasks = {
    0xcccc, 0x8888, 0xeeee, 0xecc8, 0xc880, 0xfeec, 0xfec8, 0xec80, 0xc800, 0xffec, 0xfe80,
    0xe800, 0xffe8, 0xff00, 0xfff0, 0xf000, 0xf710, 0x008e, 0x7100, 0x08ce, 0x008c, 0x7310,
    0x3100, 0x8cce, 0x088c, 0x3110, 0x6666, 0x366c, 0x17e8, 0x0ff0, 0x718e, 0x399c};

const std::array<std::uint8_t, kPartitions> kAnchors = {15, 15, 15, 15, 15, 15, 15, 15, 15, 15, 15,
                                                        15, 15, 15, 15, 15, 15, 2,  8,  2,  2,  8,
                                                        8,  15, 2,  8,  2,  2,  8,  8,  2,  2};

namespace {

// Where the bits of the endpoints lie, from the block's bit 2 or 5 on: words of a channel, an
// endpoint and its bits, "r0:0-9" for bits 0 to 9 of red in endpoint 0, "r0:15-10" with the highest
// first. The partition's five bits follow where there are two regions, then the indices.
constexpr std::array<std::string_view, kModes> kLayouts = {
    "g2:4 b2:4 b3:4 r0:0-9 g0:0-9 b0:0-9 r1:0-4 g3:4 g2:0-3 g1:0-4 b3:0 g3:0-3 b1:0-4 b3:1 b2:0-3 "
    "r2:0-4 b3:2 r3:0-4 b3:3",
    "g2:5 g3:4-5 r0:0-6 b3:0-1 b2:4 g0:0-6 b2:5 b3:2 g2:4 b0:0-6 b3:3 b3:5 b3:4 r1:0-5 g2:0-3 "
    "g1:0-5 g3:0-3 b1:0-5 b2:0-3 r2:0-5 r3:0-5",
    "r0:0-9 g0:0-9 b0:0-9 r1:0-4 r0:10 g2:0-3 g1:0-3 g0:10 b3:0 g3:0-3 b1:0-3 b0:10 b3:1 b2:0-3 "
    "r2:0-4 b3:2 r3:0-4 b3:3",
    "r0:0-9 g0:0-9 b0:0-9 r1:0-3 r0:10 g3:4 g2:0-3 g1:0-4 g0:10 g3:0-3 b1:0-3 b0:10 b3:1 b2:0-3 "
    "r2:0-3 b3:0 b3:2 r3:0-3 g2:4 b3:3",
    "r0:0-9 g0:0-9 b0:0-9 r1:0-3 r0:10 b2:4 g2:0-3 g1:0-3 g0:10 b3:0 g3:0-3 b1:0-4 b0:10 b2:0-3 "
    "r2:0-3 b3:1 b3:2 r3:0-3 b3:4 b3:3",
    "r0:0-8 b2:4 g0:0-8 g2:4 b0:0-8 b3:4 r1:0-4 g3:4 g2:0-3 g1:0-4 b3:0 g3:0-3 b1:0-4 b3:1 b2:0-3 "
    "r2:0-4 b3:2 r3:0-4 b3:3",
    "r0:0-7 g3:4 b2:4 g0:0-7 b3:2 g2:4 b0:0-7 b3:3-4 r1:0-5 g2:0-3 g1:0-4 b3:0 g3:0-3 b1:0-4 b3:1 "
    "b2:0-3 r2:0-5 r3:0-5",
    "r0:0-7 b3:0 b2:4 g0:0-7 g2:5 g2:4 b0:0-7 g3:5 b3:4 r1:0-4 g3:4 g2:0-3 g1:0-5 g3:0-3 b1:0-4 "
    "b3:1 b2:0-3 r2:0-4 b3:2 r3:0-4 b3:3",
    "r0:0-7 b3:1 b2:4 g0:0-7 b2:5 g2:4 b0:0-7 b3:5 b3:4 r1:0-4 g3:4 g2:0-3 g1:0-4 b3:0 g3:0-3 "
    "b1:0-5 b2:0-3 r2:0-4 b3:2 r3:0-4 b3:3",
    "r0:0-5 g3:4 b3:0-1 b2:4 g0:0-5 g2:5 b2:5 b3:2 g2:4 b0:0-5 g3:5 b3:3 b3:5 b3:4 r1:0-5 g2:0-3 "
    "g1:0-5 g3:0-3 b1:0-5 b2:0-3 r2:0-5 r3:0-5",
    "r0:0-9 g0:0-9 b0:0-9 r1:0-9 g1:0-9 b1:0-9",
    "r0:0-9 g0:0-9 b0:0-9 r1:0-8 r0:10 g1:0-8 g0:10 b1:0-8 b0:10",
    "r0:0-9 g0:0-9 b0:0-9 r1:0-7 r0:11-10 g1:0-7 g0:11-10 b1:0-7 b0:11-10",
    "r0:0-9 g0:0-9 b0:0-9 r1:0-3 r0:15-10 g1:0-3 g0:15-10 b1:0-3 b0:15-10"};

struct BitPlace {
  std::uint8_t endpoint, channel, bit;
};
struct Layout {
  std::array<BitPlace, 75> places = {};
  int count = 0;
};

constexpr int numberAt(std::string_view text, std::size_t& at) {
  int number = 0;
  while (at < text.size() && text[at] >= '0' && text[at] <= '9')
    number = 10 * number + (text[at++] - '0');
  return number;
}

constexpr Layout parsed(std::string_view text) {
  Layout layout;
  for (std::size_t at = 0; at < text.size(); ++at) {  // over the space
    const char name = text[at++];
    const int endpoint = numberAt(text, at);
    const int first = numberAt(text, ++at);
    const int last = at < text.size() && text[at] == '-' ? numberAt(text, ++at) : first;
    const int step = first <= last ? 1 : -1;
    for (int bit = first; bit != last + step; bit += step)
      layout.places[layout.count++] = {static_cast<std::uint8_t>(endpoint),
                                       static_cast<std::uint8_t>(name == 'r'   ? 0
                                                                 : name == 'g' ? 1
                                                                               : 2),
                                       static_cast<std::uint8_t>(bit)};
  }
  return layout;
}

constexpr std::array<Layout, kModes> parsedLayouts() {
  std::array<Layout, kModes> layouts;
  for (int mode = 0; mode < kModes; ++mode) layouts[mode] = parsed(kLayouts[mode]);
  return layouts;
}
constexpr std::array<Layout, kModes> kBitPlaces = parsedLayouts();

// The block's bits, the lowest of the first byte first.
struct Bits {
  std::uint64_t low = 0, high = 0;
  int at = 0;  // of put()

  int take(int count) {
    const auto value = static_cast<int>(low & ((1u << count) - 1));
    low = low >> count | high << (64 - count);
    high >>= count;
    return value;
  }
  void put(int value, int count) {
    const auto bits = static_cast<std::uint64_t>(value) & ((1u << count) - 1);
    if (at < 64) low |= bits << at;
    if (at >= 64)
      high |= bits << (at - 64);
    else if (at + count > 64)
      high |= bits >> (64 - at);
    at += count;
  }
};

int modeOf(int number) {
  for (int mode = 0; mode < kModes; ++mode)
    if (kModeTable[mode].number == number) return mode;
  return -1;
}

int indexBits(const Fields& fields, int texel) {
  if (kModeTable[fields.mode].regions == 1) return texel == 0 ? 3 : 4;
  return texel == 0 || texel == kAnchors[fields.partition] ? 2 : 3;
}

int signExtended(int value, int bits) {
  return value >> (bits - 1) & 1 ? value - (1 << bits) : value;
}

void addBase(const Mode& mode, std::array<std::array<int, 3>, 4>& endpoints) {
  const int mask = (1 << mode.endpointBits) - 1;
  for (int e = 1; e < 2 * mode.regions; ++e)
    for (int c = 0; c < 3; ++c)
      endpoints[e][c] = (endpoints[0][c] + signExtended(endpoints[e][c], mode.deltaBits[c])) & mask;
}

}  // namespace

std::span<const int> weightsOf(int regions) {
  if (regions == 1) return kWeights4;
  return kWeights3;
}

std::optional<Fields> unpack(std::span<const std::byte, 16> block) {
  Bits bits;
  for (int i = 0; i < 8; ++i) {
    bits.low |= std::to_integer<std::uint64_t>(block[i]) << 8 * i;
    bits.high |= std::to_integer<std::uint64_t>(block[8 + i]) << 8 * i;
  }
  int number = bits.take(2);
  if (number >= 2) number |= bits.take(3) << 2;
  Fields fields;
  fields.mode = modeOf(number);
  if (fields.mode < 0) return {};
  const Mode& mode = kModeTable[fields.mode];
  const Layout& layout = kBitPlaces[fields.mode];
  for (int i = 0; i < layout.count; ++i) {
    const BitPlace place = layout.places[i];
    fields.endpoints[place.endpoint][place.channel] |= bits.take(1) << place.bit;
  }
  if (mode.transformed) addBase(mode, fields.endpoints);
  if (mode.regions == 2) fields.partition = bits.take(5);
  for (int t = 0; t < kTexels; ++t)
    fields.indices[t] = static_cast<std::uint8_t>(bits.take(indexBits(fields, t)));
  return fields;
}

std::array<std::byte, 16> pack(const Fields& fields) {
  const Mode& mode = kModeTable[fields.mode];
  auto endpoints = fields.endpoints;
  if (mode.transformed)
    for (int e = 1; e < 4; ++e)
      for (int c = 0; c < 3; ++c) endpoints[e][c] -= endpoints[0][c];  // put() drops higher bits
  Bits bits;
  bits.put(mode.number, mode.number < 2 ? 2 : 5);
  const Layout& layout = kBitPlaces[fields.mode];
  for (int i = 0; i < layout.count; ++i) {
    const BitPlace place = layout.places[i];
    bits.put(endpoints[place.endpoint][place.channel] >> place.bit, 1);
  }
  if (mode.regions == 2) bits.put(fields.partition, 5);
  for (int t = 0; t < kTexels; ++t) bits.put(fields.indices[t], indexBits(fields, t));
  CHECK(bits.at == 128);
  std::array<std::byte, 16> block;
  for (int i = 0; i < 8; ++i) {
    block[i] = static_cast<std::byte>(bits.low >> 8 * i & 0xff);
    block[8 + i] = static_cast<std::byte>(bits.high >> 8 * i & 0xff);
  }
  return block;
}

bool fits(const Mode& mode, const std::array<std::array<int, 3>, 4>& endpoints) {
  if (!mode.transformed) return true;
  for (int e = 1; e < 2 * mode.regions; ++e)
    for (int c = 0; c < 3; ++c) {
      const int offset = endpoints[e][c] - endpoints[0][c], limit = 1 << (mode.deltaBits[c] - 1);
      if (offset < -limit || offset >= limit) return false;
    }
  return true;
}

}  // namespace lucerna::bc6h
