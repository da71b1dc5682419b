// A view frustum as six planes, and projections for reversed depth.
#pragma once

#include <array>

#include "core/math/bounds.hpp"
#include "core/math/math.hpp"

namespace lucerna {

struct Frustum {
  // xyz: unit normal pointing inward; a point p is inside where dot(xyz, p) + w >= 0.
  // Order: left, right, bottom, top, near, far. An infinite far plane is (0, 0, 0, 1).
  std::array<vec4, 6> planes;
  static constexpr std::size_t kNear = 4;
};

// Planes of clipFromSpace with clip z in [0, w] and depth reversed (near at z = w, far at z = 0),
// in the space that the matrix maps from, normalised.
Frustum frustumOf(const mat4& clipFromSpace);

// False only if the box is wholly outside one plane. This scalar predicate is the definition of
// "visible" that the BVH must reproduce.
bool intersects(const Frustum& frustum, const Aabb& box);

// Reversed-depth perspective: maps -z = near to depth 1, far to 0; far may be infinity.
// fovY: full vertical angle in radians; near, far in metres.
mat4 perspectiveReversed(float fovY, float aspect, float near, float far);
// The same for an off-axis window on the near plane (metres).
mat4 frustumReversed(float left, float right, float bottom, float top, float near, float far);
mat4 orthographicReversed(float left, float right, float bottom, float top, float near, float far);

}  // namespace lucerna
