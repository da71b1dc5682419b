#include "image/convolution.hpp"

#include <algorithm>
#include <cmath>

namespace lucerna {

Kernel gaussian(float sigma, int radius) {
  Kernel kernel{radius, {}};
  for (int x = -radius; x <= radius; ++x)
    kernel.taps.push_back(
        static_cast<float>(std::exp(-0.5 * x * x / (static_cast<double>(sigma) * sigma))));
  return kernel;
}

Kernel scaled(Kernel kernel, float factor) {
  for (float& tap : kernel.taps) tap *= factor;
  return kernel;
}

void PaddedRow::extend() {
  float* row = data();
  std::fill(row - margin_, row, row[0]);
  std::fill(row + width_, values_.data() + values_.size(), row[width_ - 1]);
}

void convolveAlong(const PaddedRow& row, const Kernel& kernel, int width, float* out) {
  const int taps = 2 * kernel.radius + 1;
  const float* weights = kernel.taps.data();
  for (int x = 0; x < width; x += kLane) {
    const float* in = row.data() + x - kernel.radius;
    float sum[kLane] = {};
    for (int t = 0; t < taps; ++t)
      for (int i = 0; i < kLane; ++i) sum[i] += weights[t] * in[t + i];
    for (int i = 0; i < kLane; ++i) out[x + i] = sum[i];
  }
}

void convolveAcross(const float* const* rows, const Kernel& kernel, int width, float* out,
                    bool accumulate) {
  const int taps = 2 * kernel.radius + 1;
  const float* weights = kernel.taps.data();
  for (int x = 0; x < width; x += kLane) {
    float sum[kLane] = {};
    for (int t = 0; t < taps; ++t)
      for (int i = 0; i < kLane; ++i) sum[i] += weights[t] * rows[t][x + i];
    for (int i = 0; i < kLane; ++i) out[x + i] = accumulate ? out[x + i] + sum[i] : sum[i];
  }
}

}  // namespace lucerna
