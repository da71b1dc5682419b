#include "core/math/convex_body.hpp"

#include <cmath>
#include <optional>

namespace lucerna {
namespace {

using glm::dvec3;

std::optional<dvec3> commonPoint(const vec4& a, const vec4& b, const vec4& c) {
  const dvec3 u(a), v(b), w(c);
  const dvec3 vw = glm::cross(v, w);
  const double volume = glm::dot(u, vw);
  if (std::abs(volume) < 1e-9) return std::nullopt;
  return -(double(a.w) * vw + double(b.w) * glm::cross(w, u) + double(c.w) * glm::cross(u, v)) /
         volume;
}

bool isInside(std::span<const vec4> planes, const dvec3& point) {
  const double slack = 1e-5 * (1. + glm::length(point));
  for (const vec4& plane : planes)
    if (glm::dot(dvec3(plane), point) + double(plane.w) < -slack) return false;
  return true;
}

}  // namespace

std::vector<vec4> planesOf(const Aabb& box) {
  std::vector<vec4> planes;
  for (int axis = 0; axis < 3; ++axis) {
    vec4 plane(0.f);
    plane[axis] = 1.f;
    planes.push_back(plane - vec4(0, 0, 0, box.min[axis]));
    planes.push_back(-plane + vec4(0, 0, 0, box.max[axis]));
  }
  return planes;
}

std::vector<vec3> cornersOf(std::span<const vec4> planes) {
  std::vector<vec3> corners;
  for (std::size_t i = 0; i < planes.size(); ++i)
    for (std::size_t j = i + 1; j < planes.size(); ++j)
      for (std::size_t k = j + 1; k < planes.size(); ++k)
        if (const auto point = commonPoint(planes[i], planes[j], planes[k]);
            point && isInside(planes, *point))
          corners.emplace_back(*point);
  return corners;
}

}  // namespace lucerna
