#include "app/bench/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace lucerna::app::bench {
namespace {

double quantile(const std::vector<double>& sorted, double share) {
  const double place = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  const double fraction = place - static_cast<double>(below);
  // Infinite samples keep std::lerp from its ends.
  if (fraction == 0 || sorted[below] == sorted[above]) return sorted[below];
  return std::lerp(sorted[below], sorted[above], fraction);
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

double quantileOf(std::span<const double> samples, double share) {
  if (samples.empty()) return 0;
  std::vector<double> sorted(samples.begin(), samples.end());
  std::ranges::sort(sorted);
  return quantile(sorted, share);
}

std::vector<double> pairedRatios(std::span<const double> samples,
                                 std::span<const double> baseline) {
  std::vector<double> ratios;
  if (samples.size() != baseline.size()) return ratios;
  for (std::size_t i = 0; i < samples.size(); ++i)
    if (baseline[i] != 0) ratios.push_back(samples[i] / baseline[i]);
  return ratios;
}

std::optional<double> onLogCurve(std::span<const glm::dvec2> points, double x) {
  const auto point = std::ranges::find(points, x, [](const glm::dvec2& p) { return p.x; });
  if (point != points.end()) return point->y > 0 ? std::optional(point->y) : std::nullopt;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const glm::dvec2 a = points[i], b = points[i + 1];
    if ((a.x < x) == (b.x < x)) continue;
    if (std::min({a.x, a.y, b.x, b.y}) <= 0) return std::nullopt;
    const double share = std::log(x / a.x) / std::log(b.x / a.x);
    return std::exp(std::lerp(std::log(a.y), std::log(b.y), share));
  }
  return std::nullopt;
}

double slopeOf(std::span<const glm::dvec2> points) {
  glm::dvec2 mean(0);
  for (const glm::dvec2 p : points) mean += p / static_cast<double>(points.size());
  double xx = 0, xy = 0;
  for (const glm::dvec2 p : points) {
    xx += (p.x - mean.x) * (p.x - mean.x);
    xy += (p.x - mean.x) * (p.y - mean.y);
  }
  return xx > 0 ? xy / xx : 0;
}

Estimate estimateTotal(std::span<const double> cost, std::span<const double> size, double allSize,
                       std::size_t parts) {
  const double sampleCost = std::accumulate(cost.begin(), cost.end(), 0.0);
  const double sampleSize = std::accumulate(size.begin(), size.end(), 0.0);
  if (sampleSize <= 0 || allSize <= 0) return {};
  const double ratio = sampleCost / sampleSize;
  Estimate estimate{.total = ratio * allSize, .share = sampleSize / allSize};
  if (cost.size() < 2) return estimate;
  double squares = 0;
  for (std::size_t i = 0; i < cost.size(); ++i)
    squares += (cost[i] - ratio * size[i]) * (cost[i] - ratio * size[i]);
  const auto n = static_cast<double>(cost.size());
  const double unseen = std::max(1 - n / static_cast<double>(parts), 0.0);
  estimate.error = allSize / (sampleSize / n) * std::sqrt(unseen * squares / (n - 1) / n);
  return estimate;
}

}  // namespace lucerna::app::bench
