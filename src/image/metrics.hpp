// Differences between two pictures of the same size.
#pragma once

#include <optional>

#include "core/result.hpp"
#include "image/image.hpp"

namespace lucerna {

struct FlipSettings {
  float pixelsPerDegree = 67.02f;  // 0.7 m from a 0.7 m wide monitor of 3840 pixels
};

// Per-pixel error in [0, 1] (F32, one channel) and its summary over the pixels under the mask (all
// zero if there is none).
struct ErrorMap {
  Image error;
  double mean = 0, weightedMedian = 0, p95 = 0, min = 0, max = 0;
};

// weightedMedian: half of the whole error lies in pixels with at most this error. p95: 95 % of the
// pixels have at most this error.
ErrorMap summarised(Image error, const Image* mask = nullptr);

// LDR-FLIP: Andersson et al., "FLIP: A Difference Evaluator for Alternating Images", HPG 2020.
// reference, test: RGB, F32, sRGB-encoded values, clamped to [0, 1]. mask: one channel U8, 0 leaves
// the pixel out of the summary (the map is made for all). A pixel that is not finite in exactly one
// of the pictures has error 1.
ErrorMap flipLdr(const Image& reference, const Image& test, const FlipSettings& settings = {},
                 const Image* mask = nullptr);

// Exposures in stops, evenly spaced from start to stop.
struct ExposureRange {
  float start = 0, stop = 0;
  int count = 2;
};

// HDR-FLIP: Andersson et al., "Visualizing Errors in Rendered High Dynamic Range Images",
// Eurographics 2021 (ACES). reference, test: RGB, F32, linear. Exposures are found from the
// reference unless given.
struct HdrFlip {
  ErrorMap map;
  float startExposure = 0, stopExposure = 0;
  int exposures = 0;
};
HdrFlip flipHdr(const Image& reference, const Image& test, const FlipSettings& settings = {},
                const Image* mask = nullptr,
                const std::optional<ExposureRange>& exposures = std::nullopt);

// PSNR in dB with peak 1 (infinity for equal pictures), SSIM (Wang et al. 2004: 11x11 Gaussian of
// sigma 1.5, on Rec. 709 luma, over the pixels whose window lies inside the picture), RMSE; over
// RGB components. reference, test: RGB, F32.
struct PixelMetrics {
  double psnr = 0, ssim = 0, rmse = 0;
};
PixelMetrics pixelMetrics(const Image& reference, const Image& test, const Image* mask = nullptr);

// Colours for an error map in [0, 1], from black over violet and orange to pale yellow, of evenly
// growing lightness: U8 RGB. Where the mask is 0 a grey that no error has: kMaskedGrey.
inline constexpr std::uint8_t kMaskedGrey = 110;
Image heatMap(const Image& error, const Image* mask = nullptr);

}  // namespace lucerna
