// What a list of samples says: the middle and how far they lie apart.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/math/math.hpp"

namespace lucerna::app::bench {

// Quantiles lie between two samples in proportion (Hyndman and Fan, "Sample Quantiles in
// Statistical Packages", 1996, definition 7). All 0 if there is no sample.
struct Spread {
  double median = 0;
  double lower = 0, upper = 0;  // quartiles
  double min = 0, max = 0;
};
Spread spreadOf(std::span<const double> samples);
// The same for any share, 0 to 1.
double quantileOf(std::span<const double> samples, double share);

// How many times as large each sample is as the baseline's of the same turn; turns in which that is
// 0 are left out. Empty if they are not as many.
std::vector<double> pairedRatios(std::span<const double> samples, std::span<const double> baseline);

// y at x of a curve through points in their order, straight between neighbours on logarithmic axes:
// that of a point at x if there is one, else where the curve first passes x. None if it never does,
// or if a value there is not above 0.
std::optional<double> onLogCurve(std::span<const glm::dvec2> points, double x);

// By how much y grows with x, by least squares; 0 of fewer than two different x.
double slopeOf(std::span<const glm::dvec2> points);

// What all of something takes, from a random sample of its parts.
struct Estimate {
  double total = 0;
  double error = 0;  // standard error of the total
  double share = 0;  // of all work, what the sample is
};
// cost and size: of each part of the sample, which is drawn without replacement; costs grow with
// sizes. size: of all `parts` together they sum to `allSize`. The ratio estimator (Cochran,
// "Sampling Techniques", 1977, section 6.3); all 0 if nothing is known.
Estimate estimateTotal(std::span<const double> cost, std::span<const double> size, double allSize,
                       std::size_t parts);

}  // namespace lucerna::app::bench
