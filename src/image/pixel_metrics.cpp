#include <algorithm>
#include <cmath>
#include <limits>

#include "core/parallel.hpp"
#include "image/convolution.hpp"
#include "image/metrics.hpp"

namespace lucerna {
namespace {

constexpr int kWindowRadius = 5;  // 11x11
constexpr float kWindowSigma = 1.5f;
constexpr float kC1 = 0.01f * 0.01f, kC2 = 0.03f * 0.03f;  // (K L)^2 with L = 1
constexpr int kBandRows = 64;

bool masked(const Image* mask, int x, int y) {
  return mask && *mask->pixel<std::uint8_t>(x, y) == 0;
}

// Mean of the squared differences of all components under the mask.
double meanSquare(const Image& reference, const Image& test, const Image* mask) {
  double sum = 0, components = 0;
  for (int y = 0; y < reference.height(); ++y) {
    const float *r = reference.pixel<float>(0, y), *t = test.pixel<float>(0, y);
    for (int x = 0; x < reference.width(); ++x) {
      if (masked(mask, x, y)) continue;
      for (int c = 0; c < 3; ++c) {
        const double d = static_cast<double>(r[3 * x + c]) - t[3 * x + c];
        sum += d * d;
      }
      components += 3;
    }
  }
  return components > 0 ? sum / components : 0;
}

// Rec. 709, less 0.5: variances do not change, and near zero they lose less to rounding.
void centredLumaRow(const Image& image, int y, float* luma) {
  const float* rgb = image.pixel<float>(0, y);
  for (int x = 0; x < image.width(); ++x)
    luma[x] = 0.2126f * rgb[3 * x] + 0.7152f * rgb[3 * x + 1] + 0.0722f * rgb[3 * x + 2] - 0.5f;
}

// Local moments of centred luma: E r, E t, E r^2, E t^2, E r t.
constexpr int kMoments = 5;

float similarity(const float* m) {
  const float varR = m[2] - m[0] * m[0], varT = m[3] - m[1] * m[1], cov = m[4] - m[0] * m[1];
  const float r = m[0] + 0.5f, t = m[1] + 0.5f;
  return (2 * r * t + kC1) * (2 * cov + kC2) / ((r * r + t * t + kC1) * (varR + varT + kC2));
}

// Sums to 1 exactly in single precision, or a plain picture would have a variance.
Kernel window() {
  Kernel kernel = gaussian(kWindowSigma, kWindowRadius);
  double sum = 0;
  for (const float tap : kernel.taps) sum += tap;
  kernel = scaled(kernel, static_cast<float>(1 / sum));
  sum = 0;
  for (const float tap : kernel.taps) sum += tap;
  kernel.taps[kWindowRadius] += static_cast<float>(1 - sum);
  return kernel;
}

class SsimBand {
 public:
  SsimBand(const Image& reference, const Image& test, int firstRow, int rows)
      : width_(reference.width()),
        stride_(paddedWidth(width_)),
        firstRow_(firstRow),
        rows_(rows),
        along_(static_cast<std::size_t>(rows) * kMoments * stride_),
        across_(static_cast<std::size_t>(kMoments) * stride_) {
    for (int row = firstRow; row < firstRow + rows; ++row) filterAlong(reference, test, row);
  }

  // The similarity at every pixel of a row.
  void row(int y, float* out) {
    for (int m = 0; m < kMoments; ++m) {
      const float* rows[2 * kWindowRadius + 1];
      for (int t = -kWindowRadius; t <= kWindowRadius; ++t)
        rows[t + kWindowRadius] = along(m, std::clamp(y + t, firstRow_, firstRow_ + rows_ - 1));
      convolveAcross(rows, kernel_, width_, across_.data() + static_cast<std::size_t>(m) * stride_);
    }
    for (int x = 0; x < width_; ++x) {
      float moments[kMoments];
      for (int m = 0; m < kMoments; ++m)
        moments[m] = across_[static_cast<std::size_t>(m) * stride_ + static_cast<std::size_t>(x)];
      out[x] = similarity(moments);
    }
  }

 private:
  float* along(int moment, int row) {
    const auto index = static_cast<std::size_t>(row - firstRow_) * kMoments + moment;
    return along_.data() + index * stride_;
  }

  void filterAlong(const Image& reference, const Image& test, int row) {
    PaddedRow r(width_, kWindowRadius), t(width_, kWindowRadius), product(width_, kWindowRadius);
    centredLumaRow(reference, row, r.data());
    centredLumaRow(test, row, t.data());
    r.extend();
    t.extend();
    convolveAlong(r, kernel_, width_, along(0, row));
    convolveAlong(t, kernel_, width_, along(1, row));
    const PaddedRow* const pairs[][2] = {{&r, &r}, {&t, &t}, {&r, &t}};
    for (int p = 0; p < 3; ++p) {
      for (int x = 0; x < width_; ++x)
        product.data()[x] = pairs[p][0]->data()[x] * pairs[p][1]->data()[x];
      product.extend();
      convolveAlong(product, kernel_, width_, along(2 + p, row));
    }
  }

  int width_, stride_, firstRow_, rows_;
  Kernel kernel_ = window();
  std::vector<float> along_, across_;
};

double meanSimilarity(const Image& reference, const Image& test, const Image* mask) {
  const int width = reference.width(), height = reference.height();
  Image map(width, height, 1, ComponentType::F32);
  parallelFor(static_cast<std::size_t>(height), kBandRows, [&](std::size_t begin, std::size_t end) {
    const int first = std::max(static_cast<int>(begin) - kWindowRadius, 0);
    const int last = std::min(static_cast<int>(end) + kWindowRadius, height);
    SsimBand band(reference, test, first, last - first);
    for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y)
      band.row(y, map.pixel<float>(0, y));
  });
  // A picture smaller than the window has no inside: all of it counts, its border repeated.
  const bool small = width <= 2 * kWindowRadius || height <= 2 * kWindowRadius;
  const int border = small ? 0 : kWindowRadius;
  double sum = 0, count = 0;
  for (int y = border; y < height - border; ++y)
    for (int x = border; x < width - border; ++x)
      if (!masked(mask, x, y)) {
        sum += *map.pixel<float>(x, y);
        ++count;
      }
  return count > 0 ? sum / count : 1;
}

}  // namespace

PixelMetrics pixelMetrics(const Image& reference, const Image& test, const Image* mask) {
  CHECK(!reference.empty() && reference.width() == test.width() &&
        reference.height() == test.height());
  for (const Image* image : {&reference, &test})
    CHECK(image->channels() == 3 && image->type() == ComponentType::F32);
  const double square = meanSquare(reference, test, mask);
  PixelMetrics metrics;
  metrics.rmse = std::sqrt(square);
  metrics.psnr = square > 0 ? -10 * std::log10(square) : std::numeric_limits<double>::infinity();
  metrics.ssim = meanSimilarity(reference, test, mask);
  return metrics;
}

}  // namespace lucerna
