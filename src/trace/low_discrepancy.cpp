#include "trace/low_discrepancy.hpp"

namespace lucerna::trace {
namespace {

std::uint32_t reversed(std::uint32_t x) {
  x = (x >> 16) | (x << 16);
  x = ((x & 0xff00ff00u) >> 8) | ((x & 0x00ff00ffu) << 8);
  x = ((x & 0xf0f0f0f0u) >> 4) | ((x & 0x0f0f0f0fu) << 4);
  x = ((x & 0xccccccccu) >> 2) | ((x & 0x33333333u) << 2);
  return ((x & 0xaaaaaaaau) >> 1) | ((x & 0x55555555u) << 1);
}

// Each bit is flipped or not by a hash of the lower ones: adding and multiplying by even numbers
// only carries upwards (Laine and Karras 2011; the constants are those of Burley's section 3).
std::uint32_t permuted(std::uint32_t x, std::uint32_t seed) {
  x += seed;
  x ^= x * 0x6c50b47cu;
  x ^= x * 0xb82f1e52u;
  x ^= x * 0xc7afe638u;
  x ^= x * 0x8d22f6e6u;
  return x;
}

// Owen scrambling: each bit by the higher ones.
std::uint32_t scrambled(std::uint32_t x, std::uint32_t seed) {
  return reversed(permuted(reversed(x), seed));
}

// The second dimension: its direction numbers are Pascal's triangle modulo 2.
std::uint32_t secondSobol(std::uint32_t index) {
  std::uint32_t result = 0;
  for (std::uint32_t direction = 1u << 31; index; index >>= 1, direction ^= direction >> 1)
    if (index & 1) result ^= direction;
  return result;
}

float unit(std::uint32_t x) {
  return static_cast<float>(x >> 8) * 0x1p-24f;
}

}  // namespace

std::uint32_t mixed(std::uint32_t hash, std::uint32_t value) {
  std::uint32_t x = hash ^ (value * 0x9e3779b9u + 0x7f4a7c15u + (hash << 6) + (hash >> 2));
  x = (x ^ (x >> 16)) * 0x7feb352du;  // lowbias32 of Wellons
  x = (x ^ (x >> 15)) * 0x846ca68bu;
  return x ^ (x >> 16);
}

vec2 lowDiscrepancyPoint(std::uint32_t index, std::uint32_t sequence) {
  const std::uint32_t shuffled = scrambled(index, mixed(sequence, 0));
  return {unit(scrambled(reversed(shuffled), mixed(sequence, 1))),
          unit(scrambled(secondSobol(shuffled), mixed(sequence, 2)))};
}

}  // namespace lucerna::trace
