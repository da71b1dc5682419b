#include "bake/smallest_rectangle.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace lucerna::bake {
namespace {

double crossOf(glm::dvec2 a, glm::dvec2 b) {
  return a.x * b.y - a.y * b.x;
}

// Counter-clockwise, without points on its sides (Andrew, "Another Efficient Algorithm for Convex
// Hulls in Two Dimensions", 1979).
std::vector<glm::dvec2> convexHull(std::vector<glm::dvec2> points) {
  std::ranges::sort(points, {}, [](glm::dvec2 p) { return std::pair(p.x, p.y); });
  std::vector<glm::dvec2> hull;
  const auto add = [&](glm::dvec2 point, std::size_t least) {
    while (hull.size() >= least + 2 &&
           crossOf(hull.back() - hull[hull.size() - 2], point - hull.back()) <= 0)
      hull.pop_back();
    hull.push_back(point);
  };
  for (const glm::dvec2 point : points) add(point, 0);
  const std::size_t lower = hull.size() - 1;
  for (auto point = points.rbegin() + 1; point != points.rend(); ++point) add(*point, lower);
  hull.pop_back();  // the first once more
  return hull;
}

}  // namespace

// One of its sides lies on an edge of the convex hull.
Rectangle smallestRectangle(std::vector<glm::dvec2> points) {
  const std::vector<glm::dvec2> hull = convexHull(std::move(points));
  Rectangle smallest;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < hull.size(); ++i) {
    Rectangle around{.along = glm::normalize(hull[(i + 1) % hull.size()] - hull[i])};
    glm::dvec2 low(std::numeric_limits<double>::infinity()), high(-low);
    for (const glm::dvec2 point : hull) {
      const glm::dvec2 at(glm::dot(point, around.along), glm::dot(point, around.across()));
      low = glm::min(low, at), high = glm::max(high, at);
    }
    around.size = high - low;
    if (around.size.x * around.size.y >= least * (1 - 1e-9)) continue;  // rounding does not choose
    least = around.size.x * around.size.y;
    around.corner = low.x * around.along + low.y * around.across();
    smallest = around;
  }
  return smallest;
}

}  // namespace lucerna::bake
