// Resizing a rendered picture to the size asked for.
#pragma once

#include "core/math/math.hpp"
#include "image/image.hpp"

namespace lucerna::app {

// All hand the image back, pixels and all, if it has the size: move it in where memory counts.

// Separable tent filter: bilinear when enlarging, widened to cover all source pixels when reducing.
// image: F32, linear.
Image resizedLinear(Image image, uvec2 size);
// The nearest pixel's value, unmixed. image: F32.
Image resizedNearest(Image image, uvec2 size);
// image: U8, sRGB-encoded colours (alpha linear); filtered in linear light.
Image resizedSrgb(Image image, uvec2 size);

}  // namespace lucerna::app
