// Pictures made of several samples a pixel: a picture some whole number of times as wide and high,
// whose pixels are the samples.
#pragma once

#include "image/image.hpp"
#include "scene/view.hpp"

namespace lucerna::app::bench {

// The plain mean of each pixel's samples in linear light. samples: U8, sRGB-encoded. Returns RGB,
// F32, sRGB-encoded.
Image meanOfSamples(const Image& samples, uvec2 size);

// Which pixels hold an edge of a surface: between neighbours among their samples the distance jumps
// or changes slope. depth: of the samples, reversed, F32. Returns U8, 255 at edges.
Image edgesOfSamples(const Image& depth, const scene::View& view, uvec2 size);

}  // namespace lucerna::app::bench
