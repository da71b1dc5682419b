#include "app/bench/cameras.hpp"

#include <gmock/gmock.h>

#include "scene/load.hpp"
#include "scene/view.hpp"

namespace lucerna::app::bench {
namespace {

scene::Scene load(const std::string& name) {
  auto scene = scene::loadScene(name);
  EXPECT_TRUE(scene) << scene.error().message;
  return scene ? std::move(*scene) : scene::Scene{};
}

bool same(const SeededCamera& a, const SeededCamera& b) {
  return a.pose.position == b.pose.position && a.pose.target == b.pose.target && a.sight == b.sight;
}

TEST(SeededCameras, AreTheSameForTheSameSeedAndTheFirstForAnyCount) {
  const scene::Scene scene = load("builtin:atrium");
  const auto three = seededCameras(scene, {.count = 3, .seed = 5});
  const auto two = seededCameras(scene, {.count = 2, .seed = 5});
  const auto other = seededCameras(scene, {.count = 1, .seed = 6});
  ASSERT_EQ(three.size(), 3u);
  EXPECT_TRUE(same(three[0], two[0]));
  EXPECT_TRUE(same(three[1], two[1]));
  EXPECT_FALSE(same(three[0], three[1]));
  EXPECT_FALSE(same(three[0], other[0]));
}

TEST(SeededCameras, LookAtSomethingFromInsideTheBox) {
  for (const char* name : {"builtin:atrium", "builtin:nightcity", "builtin:materials"}) {
    const scene::Scene scene = load(name);
    const Aabb box = scene.boundsW();
    for (const SeededCamera& camera : seededCameras(scene, {.count = 20, .seed = 0})) {
      const vec3 eye = camera.pose.position;
      EXPECT_TRUE(glm::all(glm::greaterThanEqual(eye, box.min)) &&
                  glm::all(glm::lessThanEqual(eye, box.max)))
          << name;
      EXPECT_GT(camera.sight, 0.f) << name;
      EXPECT_LT(camera.sight, box.diagonal()) << name;
    }
  }
}

// The same scene a thousand times as large is seen from places a thousand times as far apart.
TEST(SeededCameras, FollowTheScale) {
  scene::Scene scene = load("builtin:cornell");
  const auto small = seededCameras(scene, {.count = 4});
  for (scene::Node& node : scene.nodes)
    if (node.parent == scene::kNone) {
      node.translation *= 1000.f;
      node.scale *= 1000.f;
    }
  updateTransforms(scene);
  const auto large = seededCameras(scene, {.count = 4});
  for (std::size_t i = 0; i < small.size(); ++i) {
    EXPECT_LT(glm::distance(1000.f * small[i].pose.position, large[i].pose.position), 5.f);
    EXPECT_NEAR(1000.f * small[i].sight, large[i].sight, 50.f);
  }
}

TEST(SeededCameras, StandOnTheStreet) {
  const scene::Scene scene = load("builtin:nightcity");
  for (const SeededCamera& camera :
       seededCameras(scene, {.count = 10, .seed = 1, .eyeHeight = 1.7f})) {
    EXPECT_GT(camera.pose.position.y, 1.f);
    EXPECT_LT(camera.pose.position.y, 3.5f);
  }
}

TEST(SeededCameras, ASceneWithoutSurfacesIsSeenFromOutside) {
  const auto cameras = seededCameras(scene::Scene{}, {.count = 2});
  ASSERT_EQ(cameras.size(), 2u);
  EXPECT_NE(cameras[0].pose.position, cameras[0].pose.target);
}

TEST(OwnCameras, AreTheFirstOfTheScene) {
  const scene::Scene scene = load("builtin:atrium");
  const auto cameras = ownCameras(scene, 2);
  ASSERT_EQ(cameras.size(), 2u);
  EXPECT_EQ(ownCameras(scene, 10).size(), scene.cameras.size());
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const scene::View own = scene::viewOf(scene, scene.cameras[i], 1.5f);
    scene::Scene other = scene;
    const std::uint32_t added = addCamera(other, "copy", cameras[i].pose);
    const scene::View copy = scene::viewOf(other, other.cameras[added], 1.5f);
    for (int column = 0; column < 4; ++column)
      EXPECT_LT(glm::distance(own.clipFromWorld()[column], copy.clipFromWorld()[column]), 1e-4f);
  }
}

TEST(SeededCameras, APathVisitsAllOfThemFromTheFirst) {
  const auto cameras = seededCameras(load("builtin:atrium"), {.count = 5, .seed = 2});
  const CameraPath path = pathThrough(cameras);
  EXPECT_EQ(path.at(0).position, cameras[0].pose.position);
  for (const SeededCamera& camera : cameras) {
    float nearest = std::numeric_limits<float>::infinity();
    for (int second = 0; second < 5; ++second)
      nearest = std::min(nearest, glm::distance(path.at(second).position, camera.pose.position));
    EXPECT_LT(nearest, 1e-4f);
  }
}

}  // namespace
}  // namespace lucerna::app::bench
