#include "core/math/frustum.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "core/random.hpp"

namespace lucerna {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

float depthOf(const mat4& projection, vec3 pointV) {
  const vec4 clip = projection * vec4(pointV, 1);
  return clip.z / clip.w;
}

TEST(ReversedProjection, MapsNearToOneAndFarToZero) {
  const mat4 perspective = perspectiveReversed(1.f, 1.5f, 0.25f, 100.f);
  EXPECT_FLOAT_EQ(depthOf(perspective, {0, 0, -0.25f}), 1.f);
  EXPECT_NEAR(depthOf(perspective, {0, 0, -100.f}), 0.f, 1e-7f);
  EXPECT_GT(depthOf(perspective, {0, 0, -1}), depthOf(perspective, {0, 0, -2}));

  const mat4 infinite = perspectiveReversed(1.f, 1.5f, 0.25f, kInfinity);
  EXPECT_FLOAT_EQ(depthOf(infinite, {0, 0, -0.25f}), 1.f);
  EXPECT_NEAR(depthOf(infinite, {0, 0, -1e9f}), 0.f, 1e-9f);

  const mat4 orthographic = orthographicReversed(-1, 3, -2, 2, 0.5f, 10.f);
  EXPECT_FLOAT_EQ(depthOf(orthographic, {0, 0, -0.5f}), 1.f);
  EXPECT_NEAR(depthOf(orthographic, {0, 0, -10.f}), 0.f, 1e-7f);
}

TEST(ReversedProjection, MapsTheWindowToTheUnitSquare) {
  const float fovY = 0.9f, aspect = 1.7f, top = std::tan(0.45f);
  const vec4 corner =
      perspectiveReversed(fovY, aspect, 0.1f, 50.f) * vec4(3 * top * aspect, 3 * top, -3, 1);
  EXPECT_NEAR(corner.x / corner.w, 1, 1e-5f);
  EXPECT_NEAR(corner.y / corner.w, 1, 1e-5f);

  const mat4 offAxis = frustumReversed(-0.1f, 0.3f, -0.2f, 0.1f, 0.5f, kInfinity);
  const vec4 lower = offAxis * vec4(-0.1f, -0.2f, -0.5f, 1);
  const vec4 upper = offAxis * vec4(0.6f, 0.2f, -1, 1);  // the other corner, twice as far
  EXPECT_NEAR(lower.x / lower.w, -1, 1e-5f);
  EXPECT_NEAR(lower.y / lower.w, -1, 1e-5f);
  EXPECT_NEAR(upper.x / upper.w, 1, 1e-5f);
  EXPECT_NEAR(upper.y / upper.w, 1, 1e-5f);

  const mat4 orthographic = orthographicReversed(-1, 3, -2, 4, 0.5f, 10.f);
  EXPECT_NEAR((orthographic * vec4(3, 4, -5, 1)).x, 1, 1e-6f);
  EXPECT_NEAR((orthographic * vec4(-1, -2, -5, 1)).y, -1, 1e-6f);
}

// A random camera: projection times view.
mat4 randomClipFromWorld(Random& random, float far) {
  const vec3 eye(random.uniform(-5, 5), random.uniform(-5, 5), random.uniform(-5, 5));
  const vec3 target = eye + vec3(random.uniform(-1, 1), random.uniform(-1, 1), 1.5f);
  return perspectiveReversed(random.uniform(0.3f, 2.f), random.uniform(0.5f, 2.f), 0.1f, far) *
         glm::lookAt(eye, target, vec3(0, 1, 0));
}

bool insideClip(const mat4& clipFromWorld, vec3 pointW) {
  const vec4 c = clipFromWorld * vec4(pointW, 1);
  return std::abs(c.x) <= c.w && std::abs(c.y) <= c.w && c.z >= 0 && c.z <= c.w;
}

TEST(Frustum, PlanesAreNormalisedAndAgreeWithClipSpace) {
  Random random(1);
  for (int camera = 0; camera < 50; ++camera) {
    const mat4 clipFromWorld = randomClipFromWorld(random, 20.f);
    const Frustum frustum = frustumOf(clipFromWorld);
    for (const vec4& plane : frustum.planes) EXPECT_NEAR(glm::length(vec3(plane)), 1, 1e-5f);
    int decided = 0;
    for (int i = 0; i < 500; ++i) {
      const vec3 p(random.uniform(-20, 20), random.uniform(-20, 20), random.uniform(-20, 20));
      float nearest = kInfinity;
      for (const vec4& plane : frustum.planes)
        nearest = std::min(nearest, glm::dot(vec3(plane), p) + plane.w);
      if (std::abs(nearest) < 1e-3f) continue;  // on the border rounding decides
      EXPECT_EQ(nearest > 0, insideClip(clipFromWorld, p));
      ++decided;
    }
    EXPECT_GT(decided, 450);
  }
}

TEST(Frustum, PlanesStandWhereTheProjectionSays) {
  const Frustum frustum = frustumOf(perspectiveReversed(1.f, 1.f, 0.5f, 40.f));
  EXPECT_NEAR(frustum.planes[4].z, -1, 1e-5f);  // near: -z - 0.5 >= 0
  EXPECT_NEAR(frustum.planes[4].w, -0.5f, 1e-5f);
  EXPECT_NEAR(frustum.planes[5].z, 1, 1e-5f);  // far: z + 40 >= 0
  EXPECT_NEAR(frustum.planes[5].w, 40.f, 1e-3f);
  EXPECT_GT(frustum.planes[0].x, 0);
  EXPECT_LT(frustum.planes[1].x, 0);
  EXPECT_GT(frustum.planes[2].y, 0);
  EXPECT_LT(frustum.planes[3].y, 0);
}

TEST(Frustum, AnInfiniteFarPlaneExcludesNothing) {
  const mat4 clipFromWorld = perspectiveReversed(1.f, 1.f, 0.5f, kInfinity) *
                             glm::lookAt(vec3(1, 2, 3), vec3(4, 0, -2), vec3(0, 1, 0));
  const Frustum frustum = frustumOf(clipFromWorld);
  EXPECT_EQ(frustum.planes[5], vec4(0, 0, 0, 1));
  const vec3 away = vec3(1, 2, 3) + 1e7f * glm::normalize(vec3(3, -2, -5));
  EXPECT_TRUE(intersects(frustum, {away - 1.f, away + 1.f}));
}

TEST(Frustum, IntersectsIsTheTestOfAllCornersAgainstEachPlane) {
  Random random(2);
  int visible = 0, hidden = 0;
  for (int camera = 0; camera < 40; ++camera) {
    const Frustum frustum =
        frustumOf(randomClipFromWorld(random, camera % 2 == 0 ? 15.f : kInfinity));
    for (int i = 0; i < 500; ++i) {
      const vec3 centre(random.uniform(-20, 20), random.uniform(-20, 20), random.uniform(-20, 20));
      const vec3 half(random.uniform(0, 3), random.uniform(0, 3), random.uniform(0, 3));
      const Aabb box{centre - half, centre + half};
      bool expected = true;
      for (const vec4& plane : frustum.planes) {
        bool someCornerInside = false;
        for (int corner = 0; corner < 8; ++corner) {
          const float x = plane.x * (corner & 1 ? box.max.x : box.min.x);
          const float y = plane.y * (corner & 2 ? box.max.y : box.min.y);
          const float z = plane.z * (corner & 4 ? box.max.z : box.min.z);
          if (x + y + z + plane.w >= 0) someCornerInside = true;
        }
        if (!someCornerInside) expected = false;
      }
      EXPECT_EQ(intersects(frustum, box), expected);
      (expected ? visible : hidden)++;
    }
  }
  EXPECT_GT(visible, 500);
  EXPECT_GT(hidden, 500);
}

TEST(Frustum, TheEmptyBoxIsNeverVisible) {
  EXPECT_FALSE(intersects(frustumOf(perspectiveReversed(1, 1, 0.1f, 10)), Aabb{}));
}

}  // namespace
}  // namespace lucerna
