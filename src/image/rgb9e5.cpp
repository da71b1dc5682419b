#include "image/rgb9e5.hpp"

#include <algorithm>
#include <cmath>

namespace lucerna {
namespace {

constexpr int kMantissaBits = 9, kBias = 15;
constexpr std::uint32_t kMantissa = (1u << kMantissaBits) - 1;

// What a mantissa of 1 stands for.
float stepOf(int exponent) {
  return std::ldexp(1.f, exponent - kBias - kMantissaBits);
}

}  // namespace

std::uint32_t toRgb9e5(vec3 color) {
  for (int c = 0; c < 3; ++c)
    color[c] = color[c] > 0.f ? std::min(color[c], kLargestRgb9e5) : 0.f;  // NaN: 0
  const float largest = std::max({color.x, color.y, color.z});
  // The exponent with which the largest channel is below 1; frexp() of 0 gives 0.
  int exponent = 0;
  std::frexp(largest, &exponent);
  exponent = std::max(largest > 0.f ? exponent + kBias : 0, 0);
  if (std::nearbyint(largest / stepOf(exponent)) > static_cast<float>(kMantissa)) ++exponent;
  const vec3 mantissas = color / stepOf(exponent);
  const auto bits = [](float mantissa) {
    return static_cast<std::uint32_t>(std::nearbyint(mantissa));
  };
  return bits(mantissas.x) | bits(mantissas.y) << 9 | bits(mantissas.z) << 18 |
         static_cast<std::uint32_t>(exponent) << 27;
}

vec3 fromRgb9e5(std::uint32_t bits) {
  const vec3 mantissas(bits & kMantissa, bits >> 9 & kMantissa, bits >> 18 & kMantissa);
  return mantissas * stepOf(static_cast<int>(bits >> 27));
}

}  // namespace lucerna
