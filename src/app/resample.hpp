// Resizing a rendered picture to the size asked for.
#pragma once

#include "core/math/math.hpp"
#include "image/image.hpp"

namespace lucerna::app {

// Separable tent filter: bilinear when enlarging, widened to cover all source pixels when reducing.
// image: F32, linear.
Image resizedLinear(const Image& image, uvec2 size);
// The nearest pixel's value, unmixed. image: F32.
Image resizedNearest(const Image& image, uvec2 size);
// image: U8, sRGB-encoded colours (alpha linear); filtered in linear light.
Image resizedSrgb(const Image& image, uvec2 size);

}  // namespace lucerna::app
