#include "image/flip_filters.hpp"

#include <cmath>
#include <numbers>
#include <numeric>

namespace lucerna::flip {
namespace {

using std::numbers::pi;

// a sqrt(pi / b) exp(-pi^2 x^2 / b), x in degrees of visual angle (table 1).
struct Sensitivity {
  double a, b;
};
constexpr Sensitivity kAchromatic{1, 0.0047}, kRedGreen{1, 0.0053};
constexpr Sensitivity kBlueYellow1{34.1, 0.04}, kBlueYellow2{13.5, 0.025};
constexpr double kFeatureWidth = 0.082;  // degrees
// A tap beyond six standard deviations adds less than single precision resolves.
constexpr double kVisibleSigmas = 6;

double sum(const Kernel& kernel) {
  return std::accumulate(kernel.taps.begin(), kernel.taps.end(), 0.0);
}

// The paper cuts all kernels at three standard deviations of the widest.
int paperRadius(double pixelsPerDegree) {
  return static_cast<int>(
      std::ceil(3 * std::sqrt(kBlueYellow1.b / (2 * pi * pi)) * pixelsPerDegree));
}

Kernel sensitivityKernel(Sensitivity s, double pixelsPerDegree) {
  const double sigma = std::sqrt(s.b / (2 * pi * pi)) * pixelsPerDegree;
  const int radius =
      std::min(paperRadius(pixelsPerDegree), static_cast<int>(std::ceil(kVisibleSigmas * sigma)));
  return gaussian(static_cast<float>(sigma), radius);
}

Kernel normalised(const Kernel& kernel) {
  return scaled(kernel, static_cast<float>(1 / sum(kernel)));
}

// Scales the positive taps to sum to 1 and the negative ones to -1.
Kernel balanced(Kernel kernel) {
  double positive = 0, negative = 0;
  for (const float tap : kernel.taps) (tap > 0 ? positive : negative) += tap;
  for (float& tap : kernel.taps)
    tap = static_cast<float>(tap > 0 ? tap / positive : tap / -negative);
  return kernel;
}

}  // namespace

SpatialFilters spatialFilters(float pixelsPerDegree) {
  SpatialFilters filters;
  filters.achromatic = normalised(sensitivityKernel(kAchromatic, pixelsPerDegree));
  filters.redGreen = normalised(sensitivityKernel(kRedGreen, pixelsPerDegree));
  const Kernel one = sensitivityKernel(kBlueYellow1, pixelsPerDegree);
  const Kernel two = sensitivityKernel(kBlueYellow2, pixelsPerDegree);
  const double weight1 = kBlueYellow1.a * std::sqrt(pi / kBlueYellow1.b);
  const double weight2 = kBlueYellow2.a * std::sqrt(pi / kBlueYellow2.b);
  const double total = weight1 * sum(one) * sum(one) + weight2 * sum(two) * sum(two);
  filters.blueYellow1 = scaled(one, static_cast<float>(std::sqrt(weight1 / total)));
  filters.blueYellow2 = scaled(two, static_cast<float>(std::sqrt(weight2 / total)));
  return filters;
}

FeatureFilters featureFilters(float pixelsPerDegree) {
  const double sigma = 0.5 * kFeatureWidth * pixelsPerDegree;
  const int radius = static_cast<int>(std::ceil(3 * sigma));
  const Kernel bell = gaussian(static_cast<float>(sigma), radius);
  Kernel edge = bell, point = bell;
  for (std::size_t at = 0; at < bell.taps.size(); ++at) {
    const int x = static_cast<int>(at) - radius;
    edge.taps[at] *= static_cast<float>(-x);
    point.taps[at] *= static_cast<float>(static_cast<double>(x) * x / (sigma * sigma) - 1);
  }
  return {normalised(bell), balanced(edge), balanced(point)};
}

}  // namespace lucerna::flip
