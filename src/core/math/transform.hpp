// What a matrix does to normals.
#pragma once

#include "core/math/math.hpp"

namespace lucerna {

// The matrix on normals up to a positive factor: cofactors need no division, so a matrix that
// flattens an axis still gives finite normals.
inline mat3 normalMatrix(const mat3& m) {
  const mat3 cofactors(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
  return glm::dot(m[0], cofactors[0]) < 0.f ? -1.f * cofactors : cofactors;
}

}  // namespace lucerna
