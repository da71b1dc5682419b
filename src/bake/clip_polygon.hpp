// A convex polygon of the plane that is cut by lines along the axes (Sutherland and Hodgman,
// "Reentrant Polygon Clipping", 1974).
#pragma once

#include <array>
#include <span>

#include "core/math/math.hpp"

namespace lucerna::bake {

// Of a polygon; area: positive whatever the orientation. The others are 0 where the area is.
struct PolygonMoments {
  double area = 0.;
  glm::dvec2 centroid{0.};
  glm::dvec2 variance{0.};  // of x and of y, around the centroid
};

class ClipPolygon {
 public:
  explicit ClipPolygon(const std::array<vec2, 3>& corners);
  // Keeps what has sign * (p[axis] - bound) >= 0. At most four cuts.
  void cut(int axis, double bound, double sign);
  // Keeps what lies in a rectangle, instead of four cuts.
  void cutTo(glm::dvec2 low, glm::dvec2 high);
  PolygonMoments moments() const;
  std::span<const glm::dvec2> points() const { return std::span(points_).first(count_); }

 private:
  static constexpr std::size_t kMost = 8;  // a triangle cut four times has seven corners at most
  std::array<glm::dvec2, kMost> points_;
  std::size_t count_ = 0;
};

}  // namespace lucerna::bake
