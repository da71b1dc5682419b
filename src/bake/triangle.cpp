#include "bake/triangle.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lucerna::bake {

bool isFinite(vec3 p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

TriangleShape shapeOf(const std::array<vec3, 3>& corners) {
  if (!std::ranges::all_of(corners, isFinite)) return {};
  const glm::dvec3 a(corners[0]), b(corners[1]), c(corners[2]);
  const glm::dvec3 cross = glm::cross(b - a, c - a);
  const double twice = glm::length(cross);
  const double longest = std::max({glm::distance(a, b), glm::distance(b, c), glm::distance(c, a)});
  const double size = std::max({glm::length(a), glm::length(b), glm::length(c)});
  if (!(twice > longest * size * 2 * std::numeric_limits<float>::epsilon())) return {};
  return {.normal = vec3(cross / twice), .area = static_cast<float>(0.5 * twice)};
}

}  // namespace lucerna::bake
