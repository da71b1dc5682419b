// What a list of samples says: the middle and how far they lie apart.
#pragma once

#include <cstddef>
#include <span>

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

// y at x of a curve through points, x rising, all above 0: straight between neighbours on
// logarithmic axes, the nearest point's y outside.
double onLogCurve(std::span<const glm::dvec2> points, double x);

}  // namespace lucerna::app::bench
