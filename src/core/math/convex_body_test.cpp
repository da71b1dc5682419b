#include "core/math/convex_body.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/math/frustum.hpp"

namespace lucerna {
namespace {

Aabb boxOf(const std::vector<vec3>& points) {
  Aabb box;
  for (const vec3& point : points) box.grow(point);
  return box;
}

TEST(ConvexBody, ABoxHasItsEightCorners) {
  const Aabb box{vec3(-1, 2, -3), vec3(4, 5, 6)};
  const auto corners = cornersOf(planesOf(box));
  EXPECT_EQ(corners.size(), 8u);
  EXPECT_EQ(boxOf(corners).min, box.min);
  EXPECT_EQ(boxOf(corners).max, box.max);
}

TEST(ConvexBody, AFrustumWithoutEndIsCutOffByABox) {
  const Frustum frustum =
      frustumOf(perspectiveReversed(0.5f * kPi, 1.f, 1.f, std::numeric_limits<float>::infinity()));
  std::vector<vec4> planes = planesOf({vec3(-5, -100, -10), vec3(5, 100, 10)});
  planes.insert(planes.end(), frustum.planes.begin(), frustum.planes.end());
  const Aabb found = boxOf(cornersOf(planes));
  const Aabb expected{vec3(-5, -10, -10), vec3(5, 10, -1)};
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(found.min[axis], expected.min[axis], 1e-4f);
    EXPECT_NEAR(found.max[axis], expected.max[axis], 1e-4f);
  }
}

TEST(ConvexBody, WhatHasNoCommonPartHasNoCorners) {
  std::vector<vec4> planes = planesOf({vec3(0), vec3(1)});
  planes.emplace_back(1, 0, 0, -2);
  EXPECT_TRUE(cornersOf(planes).empty());
}

}  // namespace
}  // namespace lucerna
