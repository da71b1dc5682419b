#include "app/bench/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/check.hpp"

namespace lucerna::app::bench {
namespace {

double quantile(const std::vector<double>& sorted, double share) {
  const double place = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return std::lerp(sorted[below], sorted[above], place - static_cast<double>(below));
}

}  // namespace

Spread spreadOf(std::span<const double> samples) {
  if (samples.empty()) return {};
  std::vector<double> sorted(samples.begin(), samples.end());
  std::ranges::sort(sorted);
  return {.median = quantile(sorted, 0.5),
          .lower = quantile(sorted, 0.25),
          .upper = quantile(sorted, 0.75),
          .min = sorted.front(),
          .max = sorted.back()};
}

double onLogCurve(std::span<const glm::dvec2> points, double x) {
  CHECK(!points.empty());
  std::size_t right = 0;
  while (right < points.size() && points[right].x < x) ++right;
  if (right == 0) return points.front().y;
  if (right == points.size()) return points.back().y;
  const glm::dvec2 a = glm::log(points[right - 1]), b = glm::log(points[right]);
  return std::exp(std::lerp(a.y, b.y, (std::log(x) - a.x) / (b.x - a.x)));
}

}  // namespace lucerna::app::bench
