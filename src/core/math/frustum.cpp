#include "core/math/frustum.hpp"

#include <cmath>

namespace lucerna {
namespace {

vec4 rowOf(const mat4& m, int row) {
  return {m[0][row], m[1][row], m[2][row], m[3][row]};
}

// A plane without a normal (the far plane of an infinite projection) excludes nothing.
vec4 normalisedPlane(vec4 plane) {
  const float length = glm::length(vec3(plane));
  return length > 0 ? plane / length : vec4(0, 0, 0, 1);
}

}  // namespace

// Gribb and Hartmann, "Fast Extraction of Viewing Frustum Planes from the World-View-Projection
// Matrix", 2001: each clip inequality, such as -w <= x, is linear in the point.
Frustum frustumOf(const mat4& clipFromSpace) {
  const vec4 x = rowOf(clipFromSpace, 0), y = rowOf(clipFromSpace, 1);
  const vec4 z = rowOf(clipFromSpace, 2), w = rowOf(clipFromSpace, 3);
  return {{normalisedPlane(w + x), normalisedPlane(w - x), normalisedPlane(w + y),
           normalisedPlane(w - y), normalisedPlane(w - z), normalisedPlane(z)}};
}

bool intersects(const Frustum& frustum, const Aabb& box) {
  if (box.empty()) return false;
  for (const vec4& plane : frustum.planes) {
    // The corner farthest along the inward normal decides.
    const float x = plane.x * (plane.x >= 0 ? box.max.x : box.min.x);
    const float y = plane.y * (plane.y >= 0 ? box.max.y : box.min.y);
    const float z = plane.z * (plane.z >= 0 ? box.max.z : box.min.z);
    if (x + y + z + plane.w < 0) return false;
  }
  return true;
}

mat4 perspectiveReversed(float fovY, float aspect, float near, float far) {
  const float top = near * std::tan(0.5f * fovY);
  return frustumReversed(-top * aspect, top * aspect, -top, top, near, far);
}

mat4 frustumReversed(float left, float right, float bottom, float top, float near, float far) {
  // With w = -z, depth = (a z + b) / -z is 1 at z = -near and 0 at z = -far when
  // a = near / (far - near) and b = far a; as far grows without bound, a = 0 and b = near.
  const bool infinite = std::isinf(far);
  const float a = infinite ? 0.f : near / (far - near);
  const float b = infinite ? near : far * a;
  mat4 m(0.f);
  m[0][0] = 2 * near / (right - left);
  m[1][1] = 2 * near / (top - bottom);
  m[2] = vec4((right + left) / (right - left), (top + bottom) / (top - bottom), a, -1);
  m[3][2] = b;
  return m;
}

mat4 orthographicReversed(float left, float right, float bottom, float top, float near, float far) {
  // depth = (z + far) / (far - near): 1 at z = -near, 0 at z = -far.
  mat4 m(1.f);
  m[0][0] = 2 / (right - left);
  m[1][1] = 2 / (top - bottom);
  m[2][2] = 1 / (far - near);
  m[3] = vec4(-(right + left) / (right - left), -(top + bottom) / (top - bottom),
              far / (far - near), 1);
  return m;
}

}  // namespace lucerna
