// The FLIP error map of two pictures given row by row. Private to this folder.
#pragma once

#include <functional>

#include "image/image.hpp"

namespace lucerna::flip {

// Fills planes[0..2] (linear red, green, blue in [0, 1]) of row y; called from several threads.
using RowSource = std::function<void(int y, float* const* planes)>;

// One channel, F32, in [0, 1].
Image errorMap(int width, int height, const RowSource& reference, const RowSource& test,
               float pixelsPerDegree);

}  // namespace lucerna::flip
