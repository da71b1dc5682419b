#include "bake/clip_polygon.hpp"

#include <cmath>

namespace lucerna::bake {

using glm::dvec2;

ClipPolygon::ClipPolygon(const std::array<vec2, 3>& corners) {
  for (const vec2 corner : corners) points_[count_++] = corner;
}

void ClipPolygon::cut(int axis, double bound, double sign) {
  std::array<dvec2, kMost> kept;
  std::size_t n = 0;
  for (std::size_t i = 0; i < count_; ++i) {
    const dvec2 p = points_[i], q = points_[(i + 1) % count_];
    const double dp = sign * (p[axis] - bound), dq = sign * (q[axis] - bound);
    if (dp >= 0.) kept[n++] = p;
    if ((dp < 0. && dq > 0.) || (dp > 0. && dq < 0.)) kept[n++] = p + (q - p) * (dp / (dp - dq));
  }
  points_ = kept;
  count_ = n;
}

void ClipPolygon::cutTo(dvec2 low, dvec2 high) {
  for (int axis = 0; axis < 2; ++axis) {
    cut(axis, low[axis], 1.);
    cut(axis, high[axis], -1.);
  }
}

// Over a fan of triangles; a triangle's mean of x^2 is that of its corners and of their sum.
PolygonMoments ClipPolygon::moments() const {
  double twice = 0.;
  dvec2 first(0.), second(0.);
  for (std::size_t i = 1; i + 1 < count_; ++i) {
    // From the first corner, which keeps the digits of a small polygon.
    const dvec2 b = points_[i] - points_[0], c = points_[i + 1] - points_[0];
    const double part = b.x * c.y - b.y * c.x;
    twice += part;
    first += part * (b + c) / 3.;
    second += part * (b * b + c * c + b * c) / 6.;
  }
  if (twice == 0.) return {};
  const dvec2 mean = first / twice;
  return {.area = std::abs(0.5 * twice),
          .centroid = points_[0] + mean,
          .variance = glm::max(second / twice - mean * mean, dvec2(0.))};
}

}  // namespace lucerna::bake
