#include "bake/polygon_light.hpp"

#include <array>
#include <cmath>

#include "core/check.hpp"

namespace lucerna::bake {
namespace {

// Of directions a and b, of any length: the angle between them times the unit normal of their plane
// along n.
float sideTerm(vec3 a, vec3 b, vec3 n) {
  const vec3 across = glm::cross(a, b);
  const float sine = glm::length(across);
  if (!(sine > 0.f)) return 0.f;
  return std::atan2(sine, glm::dot(a, b)) * glm::dot(across, n) / sine;
}

}  // namespace

float polygonIrradiance(std::span<const vec3> corners, vec3 position, vec3 normal) {
  constexpr std::size_t kMost = 8;
  CHECK(corners.size() >= 3 && corners.size() <= kMost);
  std::array<vec3, kMost + 1> seen;  // one corner cut off gives two
  std::size_t count = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const vec3 a = corners[i] - position, b = corners[(i + 1) % corners.size()] - position;
    const float ha = glm::dot(a, normal), hb = glm::dot(b, normal);
    if (ha >= 0.f) seen[count++] = a;
    if ((ha < 0.f && hb > 0.f) || (ha > 0.f && hb < 0.f))
      seen[count++] = a + (b - a) * (ha / (ha - hb));
  }
  if (count < 3) return 0.f;
  float sum = 0.f;
  for (std::size_t i = 0; i < count; ++i) sum += sideTerm(seen[i], seen[(i + 1) % count], normal);
  return 0.5f * std::abs(sum);
}

}  // namespace lucerna::bake
