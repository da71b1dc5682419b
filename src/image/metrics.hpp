// Differences between two pictures of the same size.
#pragma once

#include <optional>

#include "core/result.hpp"
#include "image/image.hpp"

namespace lucerna {

struct FlipSettings {
  float pixelsPerDegree = 67.02f;  // 0.7 m from a 0.7 m wide monitor of 3840 pixels
};

// Per-pixel error in [0, 1] (F32, one channel) and its summary over the pixels under the mask.
struct ErrorMap {
  Image error;
  double mean = 0, weightedMedian = 0, p95 = 0, min = 0, max = 0;
};

// LDR-FLIP: Andersson et al., "FLIP: A Difference Evaluator for Alternating Images", HPG 2020.
// reference, test: RGB, F32, sRGB-encoded values in [0, 1]. mask: one channel U8, 0 leaves the
// pixel out of the summary (the map is made for all).
ErrorMap flipLdr(const Image& reference, const Image& test, const FlipSettings& settings = {},
                 const Image* mask = nullptr);

// HDR-FLIP: Andersson et al., "Visualizing Errors in Rendered High Dynamic Range Images",
// Eurographics 2021 (ACES). reference, test: RGB, F32, linear. Exposures are found from the
// reference unless given.
struct HdrFlip {
  ErrorMap map;
  float startExposure = 0, stopExposure = 0;
  int exposures = 0;
};
HdrFlip flipHdr(const Image& reference, const Image& test, const FlipSettings& settings = {},
                const Image* mask = nullptr);

// PSNR in dB with peak 1 (infinity for equal pictures), SSIM (Wang et al. 2004: 11x11 Gaussian of
// sigma 1.5, on Rec. 709 luma), RMSE; over RGB components.
struct PixelMetrics {
  double psnr = 0, ssim = 0, rmse = 0;
};
PixelMetrics pixelMetrics(const Image& reference, const Image& test, const Image* mask = nullptr);

// Magma-like colours for an error map: U8 RGB.
Image heatMap(const Image& error);

}  // namespace lucerna
