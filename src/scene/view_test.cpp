#include "scene/view.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.hpp"

namespace lucerna::scene {
namespace {

vec3 ndcOf(const View& view, vec3 pointW) {
  const vec4 clip = view.clipFromWorld() * vec4(pointW, 1.f);
  return vec3(clip) / clip.w;
}

View viewFrom(vec3 eye, vec3 target, bool orthographic) {
  View view;
  view.viewFromWorld = glm::lookAt(eye, target, vec3(0, 1, 0));
  view.worldFromView = glm::inverse(view.viewFromWorld);
  view.orthographic = orthographic;
  view.near = 0.5f;
  view.far = 20.f;
  view.clipFromView = orthographic ? orthographicReversed(-4, 3, -2, 2, view.near, view.far)
                                   : frustumReversed(-0.4f, 0.3f, -0.2f, 0.2f, view.near, view.far);
  return view;
}

// A point is seen in the mirror where its mirror image would be seen behind it.
TEST(ReflectedView, ShowsPointsWhereTheirMirrorImagesAre) {
  Random random(4);
  const vec4 planeW(glm::normalize(vec3(1, 2, -0.5f)), 3.f);
  const Aabb boundsW{vec3(-30), vec3(30)};
  for (const bool orthographic : {false, true}) {
    const View view = viewFrom({1, 2, 3}, {-1, -2, 0}, orthographic);
    const View reflected = reflectedView(view, planeW, 0.25f, boundsW);
    EXPECT_TRUE(reflected.mirrored());
    EXPECT_FALSE(view.mirrored());
    EXPECT_FALSE(reflectedView(reflected, planeW, 0, boundsW).mirrored());
    for (int i = 0; i < 100; ++i) {
      const vec3 p(random.uniform(-9, 9), random.uniform(-9, 9), random.uniform(-9, 9));
      const float distance = glm::dot(planeW, vec4(p, 1.f));
      const vec3 image = p - 2 * distance * vec3(planeW);
      if ((view.viewFromWorld * vec4(image, 1.f)).z > -0.5f) continue;
      EXPECT_LT(glm::distance(vec2(ndcOf(view, image)), vec2(ndcOf(reflected, p))), 1e-4f);
      EXPECT_NEAR(glm::dot(*reflected.clipPlaneW, vec4(p, 1.f)), distance - 0.25f, 1e-5f);
    }
    const mat4 unit = reflected.worldFromView * reflected.viewFromWorld;
    for (int column = 0; column < 4; ++column)
      EXPECT_LT(glm::distance(unit[column], mat4(1.f)[column]), 1e-5f);
  }
}

// What a mirror shows lies farther away than what the view was made to see.
TEST(ReflectedView, SeesAllThatThereIs) {
  const Aabb boundsW{vec3(-30), vec3(30)};
  for (const bool orthographic : {false, true}) {
    const View view = viewFrom({0, 0, 0}, {0, 0, -1}, orthographic);
    const View reflected = reflectedView(view, {0, 0, 1, 15}, 0, boundsW);
    const auto depthAt = [&](float z) { return ndcOf(reflected, {0, 0, z}).z; };
    EXPECT_GT(depthAt(-10), depthAt(0));
    EXPECT_GT(depthAt(0), depthAt(29));
    EXPECT_GT(depthAt(29), 0.f);
    EXPECT_LT(depthAt(-14), 1.f);
  }
}

TEST(View, EyeIsAPlaceOrADirection) {
  EXPECT_LT(glm::distance(viewFrom({1, 2, 3}, {0, 0, 0}, false).eyeW(), vec4(1, 2, 3, 1)), 1e-5f);
  EXPECT_LT(glm::distance(viewFrom({0, 0, 9}, {0, 0, 0}, true).eyeW(), vec4(0, 0, 1, 0)), 1e-6f);
}

}  // namespace
}  // namespace lucerna::scene
