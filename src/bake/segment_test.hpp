// Whether a segment meets a triangle. After Woop, Benthin and Wald, "Watertight Ray/Triangle
// Intersection", JCGT 2013: what the segment is looked along, seen from its start. An edge that two
// triangles share has the same value in both, but for its sign, so nothing slips through between.
// Here in double precision, which needs no second try.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "core/math/math.hpp"

namespace lucerna::bake {

class SegmentTest {
 public:
  // clear, clearOfEnd: the shares of the segment, at its start and its end, that meet nothing.
  SegmentTest(vec3 from, vec3 to, float clear, float clearOfEnd = 0.f)
      : from_(from), clear_(clear), most_(1. - clearOfEnd) {
    const glm::dvec3 along = glm::dvec3(to) - from_;
    const glm::dvec3 size = glm::abs(along);
    z_ = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    x_ = (z_ + 1) % 3;
    y_ = (z_ + 2) % 3;
    shearX_ = along[x_] / along[z_];
    shearY_ = along[y_] / along[z_];
    length_ = along[z_];
  }

  // Edges are inside, and so is the segment's end. barycentric: weights of the second and third
  // corner, set if so. A segment of no length, one with a NaN and one in the triangle's plane meet
  // nothing.
  bool meets(const std::array<vec3, 3>& corners, vec2& barycentric) const {
    const Seen a = seen(corners[0]), b = seen(corners[1]), c = seen(corners[2]);
    const double u = c.x * b.y - c.y * b.x, v = a.x * c.y - a.y * c.x, w = b.x * a.y - b.y * a.x;
    if (std::min(std::min(u, v), w) < 0. && std::max(std::max(u, v), w) > 0.) return false;
    const double sum = u + v + w;
    const double depth = (u * a.z + v * b.z + w * c.z) / length_;  // times the sum
    if (!(sum > 0. ? depth > clear_ * sum && depth <= most_ * sum
                   : depth < clear_ * sum && depth >= most_ * sum))
      return false;
    barycentric = vec2(static_cast<float>(v / sum), static_cast<float>(w / sum));
    return true;
  }

 private:
  // A point from the start, sheared so that the segment runs along z.
  struct Seen {
    double x, y, z;
  };
  Seen seen(vec3 p) const {
    const double z = p[z_] - from_[z_];
    return {p[x_] - from_[x_] - shearX_ * z, p[y_] - from_[y_] - shearY_ * z, z};
  }

  glm::dvec3 from_;
  int x_, y_, z_;  // z: the axis of most extent; x, y: those that follow it
  double shearX_, shearY_, length_, clear_, most_;
};

}  // namespace lucerna::bake
