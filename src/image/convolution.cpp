#include "image/convolution.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace lucerna {
namespace {

// Four floats, which every 64-bit machine has registers for; a block of them is summed at a time.
using Float4 = float __attribute__((vector_size(16)));
constexpr int kParts = kLane / 4;

struct Block {
  Float4 parts[kParts] = {};

  void load(const float* from) { std::memcpy(parts, from, sizeof parts); }
  void store(float* to) const { std::memcpy(to, parts, sizeof parts); }
  void add(float weight, const float* from) {
    for (int i = 0; i < kParts; ++i) {
      Float4 values;
      std::memcpy(&values, from + 4 * i, sizeof values);
      parts[i] += weight * values;
    }
  }
};

}  // namespace

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
    Block sum;
    for (int t = 0; t < taps; ++t) sum.add(weights[t], in + t);
    sum.store(out + x);
  }
}

void convolveAcross(const float* const* rows, const Kernel& kernel, int width, float* out,
                    bool accumulate) {
  const int taps = 2 * kernel.radius + 1;
  const float* weights = kernel.taps.data();
  for (int x = 0; x < width; x += kLane) {
    Block sum;
    if (accumulate) sum.load(out + x);
    for (int t = 0; t < taps; ++t) sum.add(weights[t], rows[t] + x);
    sum.store(out + x);
  }
}

}  // namespace lucerna
