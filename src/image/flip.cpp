// LDR- and HDR-FLIP as sources of rows for flip_core, and how HDR-FLIP chooses its exposures.
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/parallel.hpp"
#include "image/flip_core.hpp"
#include "image/metrics.hpp"
#include "image/vector_math.hpp"

namespace lucerna {
namespace {

constexpr float kLargestRadiance = 1e15f;  // keeps the tone curve's squares finite

void checkPair(const Image& reference, const Image& test) {
  CHECK(!reference.empty() && reference.width() == test.width() &&
            reference.height() == test.height(),
        "metrics of {}x{} and {}x{} pixels", reference.width(), reference.height(), test.width(),
        test.height());
  for (const Image* image : {&reference, &test})
    CHECK(image->channels() == 3 && image->type() == ComponentType::F32);
}

// NaN becomes 0.
inline float clampedTo(float v, float largest) {
  const float positive = v > 0 ? v : 0.f;
  return positive < largest ? positive : largest;
}

inline float decodedSrgb(float encoded) {
  const float v = clampedTo(encoded, 1.f);
  const float curve = vectorPow((v + 0.055f) / 1.055f, 2.4f);
  return v <= 0.04045f ? v / 12.92f : curve;
}

// Narkowicz's fit to the ACES curve as HDR-FLIP uses it, with the 0.6 of exposure folded in:
// (k0 x^2 + k1 x) / (k3 x^2 + k4 x + k5).
constexpr float k0 = 0.6f * 0.6f * 2.51f, k1 = 0.6f * 0.03f;
constexpr float k3 = 0.6f * 0.6f * 2.43f, k4 = 0.6f * 0.59f, k5 = 0.14f;

inline float toneMapped(float x) {
  return clampedTo((k0 * x * x + k1 * x) / (k3 * x * x + k4 * x + k5), 1.f);
}

// Channel c of a row of interleaved pixels.
void deinterleave(const float* row, int channel, int width, float* plane) {
  for (int x = 0; x < width; ++x) plane[x] = row[3 * x + channel];
}

LUCERNA_WIDE_VECTORS
void decodeSrgb(float* values, int count) {
  for (int i = 0; i < count; ++i) values[i] = decodedSrgb(values[i]);
}

LUCERNA_WIDE_VECTORS
void toneMap(float* values, int count, float scale) {
  for (int i = 0; i < count; ++i)
    values[i] = toneMapped(scale * clampedTo(values[i], kLargestRadiance));
}

flip::RowSource srgbRows(const Image& image) {
  return [&image](int y, float* const* planes) {
    for (int c = 0; c < 3; ++c) {
      deinterleave(image.pixel<float>(0, y), c, image.width(), planes[c]);
      decodeSrgb(planes[c], image.width());
    }
  };
}

flip::RowSource toneMappedRows(const Image& image, float exposure) {
  const float scale = std::exp2(exposure);
  return [&image, scale](int y, float* const* planes) {
    for (int c = 0; c < 3; ++c) {
      deinterleave(image.pixel<float>(0, y), c, image.width(), planes[c]);
      toneMap(planes[c], image.width(), scale);
    }
  };
}

// A picture with a broken pixel must not look better for it.
void markBrokenPixels(const Image& reference, const Image& test, Image& error) {
  const auto finite = [](const float* p) {
    return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
  };
  const std::size_t width = static_cast<std::size_t>(reference.width());
  parallelFor(static_cast<std::size_t>(reference.height()), 64,
              [&](std::size_t y0, std::size_t y1) {
                const float *r = reference.as<float>().data(), *t = test.as<float>().data();
                float* e = error.as<float>().data();
                for (std::size_t i = y0 * width; i < y1 * width; ++i)
                  if (finite(r + 3 * i) != finite(t + 3 * i)) e[i] = 1;
              });
}

// Where the tone curve reaches 0.85: the exposures reach from the one that shows the brightest
// pixel there to the one that shows the median there (HDR-FLIP, section 4.2).
ExposureRange exposuresFor(const Image& reference) {
  constexpr double kTarget = 0.85;
  const double a = k0 - kTarget * k3, b = k1 - kTarget * k4, c = -kTarget * k5;
  const double level = (-b + std::sqrt(b * b - 4 * a * c)) / (2 * a);

  const std::size_t pixels = reference.as<float>().size() / 3;
  const float* rgb = reference.as<float>().data();
  std::vector<float> luminance(pixels);
  for (std::size_t i = 0; i < pixels; ++i)
    luminance[i] = 0.212636822f * clampedTo(rgb[3 * i], kLargestRadiance) +
                   0.715182982f * clampedTo(rgb[3 * i + 1], kLargestRadiance) +
                   0.072180196f * clampedTo(rgb[3 * i + 2], kLargestRadiance);
  const auto middle = luminance.begin() + static_cast<std::ptrdiff_t>(pixels / 2);
  std::nth_element(luminance.begin(), middle, luminance.end());
  constexpr float kDarkest = std::numeric_limits<float>::epsilon();
  const float median = std::max(*middle, kDarkest);
  const float largest = std::max(*std::max_element(middle, luminance.end()), kDarkest);

  ExposureRange range;
  range.start = static_cast<float>(std::log2(level / largest));
  range.stop = static_cast<float>(std::log2(level / median));
  range.count = std::max(2, static_cast<int>(std::ceil(range.stop - range.start)));
  return range;
}

}  // namespace

ErrorMap flipLdr(const Image& reference, const Image& test, const FlipSettings& settings,
                 const Image* mask) {
  checkPair(reference, test);
  Image error = flip::errorMap(reference.width(), reference.height(), srgbRows(reference),
                               srgbRows(test), settings.pixelsPerDegree);
  markBrokenPixels(reference, test, error);
  return summarised(std::move(error), mask);
}

HdrFlip flipHdr(const Image& reference, const Image& test, const FlipSettings& settings,
                const Image* mask, const std::optional<ExposureRange>& exposures) {
  checkPair(reference, test);
  const ExposureRange range = exposures ? *exposures : exposuresFor(reference);
  CHECK(range.count >= 1);
  Image largest(reference.width(), reference.height(), 1, ComponentType::F32);
  for (int i = 0; i < range.count; ++i) {
    const float share =
        range.count == 1 ? 0.f : static_cast<float>(i) / static_cast<float>(range.count - 1);
    const float exposure = range.start + share * (range.stop - range.start);
    const Image error =
        flip::errorMap(reference.width(), reference.height(), toneMappedRows(reference, exposure),
                       toneMappedRows(test, exposure), settings.pixelsPerDegree);
    const auto from = error.as<float>();
    const auto to = largest.as<float>();
    for (std::size_t p = 0; p < to.size(); ++p) to[p] = std::max(to[p], from[p]);
  }
  markBrokenPixels(reference, test, largest);
  return {summarised(std::move(largest), mask), range.start, range.stop, range.count};
}

}  // namespace lucerna
