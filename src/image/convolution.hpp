// One-dimensional convolutions of rows of floats, in blocks that compilers keep in registers.
// Buffers have a stride that is a multiple of kLane and are written up to it.
#pragma once

#include <cstddef>
#include <vector>

namespace lucerna {

constexpr int kLane = 16;

constexpr int paddedWidth(int width) {
  return (width + kLane - 1) / kLane * kLane;
}

struct Kernel {
  int radius = 0;
  std::vector<float> taps;  // 2 radius + 1
};

// exp(-x^2 / (2 sigma^2)) at whole x, not normalised.
Kernel gaussian(float sigma, int radius);
Kernel scaled(Kernel kernel, float factor);

// A row with room for `margin` copies of its end values on both sides.
class PaddedRow {
 public:
  PaddedRow(int width, int margin)
      : width_(width),
        margin_(margin),
        values_(static_cast<std::size_t>(paddedWidth(width) + 2 * margin)) {}
  float* data() { return values_.data() + margin_; }
  const float* data() const { return values_.data() + margin_; }
  // Repeats the first and the last value outwards; call it after data()[0, width) changed.
  void extend();

 private:
  int width_, margin_;
  std::vector<float> values_;
};

// out[x] = sum over t of taps[t] row[x + t - radius]; the row's margin is at least the radius.
void convolveAlong(const PaddedRow& row, const Kernel& kernel, int width, float* out);
// out[x] = (or +=) sum over t of taps[t] rows[t][x]; rows: 2 radius + 1 pointers.
void convolveAcross(const float* const* rows, const Kernel& kernel, int width, float* out,
                    bool accumulate = false);

}  // namespace lucerna
