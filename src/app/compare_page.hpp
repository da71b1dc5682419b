// lucerna compare --html: one page that shows where two pictures differ, and by how much.
#pragma once

#include <string>

#include "core/result.hpp"
#include "image/metrics.hpp"

namespace lucerna::app {

struct Comparison {
  std::string referenceName{}, testName{};
  Image reference{}, test{};  // of one size, as compared: F32 RGB, linear if hdr, else sRGB-encoded
  bool hdr = false;
  bool eightBit = false;  // both files hold bytes: the page names values as 0 to 255
  ErrorMap flip{};        // the error of every pixel
  PixelMetrics pixels{};
};

// The page holds both pictures and `heatMap` as PNG, the error and (unless eightBit) the values as
// half floats. Errors: those of encoding a picture.
Result<std::string> comparePage(const Comparison& comparison, const Image& heatMap);

// How half floats travel in a picture that any browser can read: U8, the high bytes of the rows
// above all low bytes. image: F32.
Image halvesAsBytes(const Image& image);

}  // namespace lucerna::app
