// Linear colour in 32 bits: nine bits of mantissa for each of red, green and blue, from the lowest
// bit on, and five of an exponent that they share (EXT_texture_shared_exponent, VkFormat
// E5B9G9R9_UFLOAT_PACK32).
#pragma once

#include <cstdint>

#include "core/math/math.hpp"

namespace lucerna {

inline constexpr float kLargestRgb9e5 = 65408.f;

// The nearest there is. Of what is not a positive number 0, of what is too large the largest.
// Each channel is off by at most 1/512 of the largest channel, or by 2^-25 where that is less than
// 2^-16.
std::uint32_t toRgb9e5(vec3 color);

vec3 fromRgb9e5(std::uint32_t bits);

}  // namespace lucerna
