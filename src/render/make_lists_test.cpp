#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "core/random.hpp"
#include "render/draw_list.hpp"

namespace lucerna::render {
namespace {

using ::testing::ElementsAre;

scene::Object objectAt(vec3 center, std::uint32_t material = 0, std::uint32_t mesh = 0) {
  return {.node = 0, .mesh = mesh, .material = material, .boundsW = {center - 0.5f, center + 0.5f}};
}

GpuScene gpuSceneOf(const scene::Scene& scene) {
  GpuScene gpuScene;
  gpuScene.scene = &scene;
  gpuScene.mirrored.assign(scene.objects.size(), false);
  return gpuScene;
}

TEST(SortBackToFront, PutsTheFarthestFirst) {
  scene::Scene scene;
  for (const float z : {-3.f, -9.f, -1.f}) scene.objects.push_back(objectAt({0, 0, z}));
  std::vector<std::uint32_t> objects = {0, 1, 2};
  sortBackToFront(gpuSceneOf(scene), scene::View{}, objects);
  EXPECT_THAT(objects, ElementsAre(1, 0, 2));
}

TEST(SortBackToFront, FollowsTheView) {
  scene::Scene scene;
  for (const float z : {-3.f, -9.f, -1.f}) scene.objects.push_back(objectAt({0, 0, z}));
  scene::View view;  // from behind, looking along +z
  view.worldFromView = glm::inverse(glm::lookAt(vec3(0, 0, -20), vec3(0), vec3(0, 1, 0)));
  view.viewFromWorld = glm::inverse(view.worldFromView);
  std::vector<std::uint32_t> objects = {0, 1, 2};
  sortBackToFront(gpuSceneOf(scene), view, objects);
  EXPECT_THAT(objects, ElementsAre(2, 0, 1));
}

// The trap "unstable sort of transparent objects": equal depths must not depend on the order in
// which culling found the objects.
TEST(SortBackToFront, GivesOneOrderForEveryOrderOfInput) {
  scene::Scene scene;
  Random random(11);
  for (int i = 0; i < 100; ++i)
    scene.objects.push_back(objectAt({random.uniform(), 0, -static_cast<float>(i % 5)}));
  const GpuScene gpuScene = gpuSceneOf(scene);
  std::vector<std::uint32_t> expected(100);
  std::iota(expected.begin(), expected.end(), 0u);
  sortBackToFront(gpuScene, scene::View{}, expected);
  for (std::size_t i = 1; i < expected.size(); ++i) {
    if (expected[i] % 5 == expected[i - 1] % 5) {
      EXPECT_LT(expected[i - 1], expected[i]);
    }
  }
  for (int round = 0; round < 20; ++round) {
    std::vector<std::uint32_t> objects(100);
    std::iota(objects.begin(), objects.end(), 0u);
    for (std::uint32_t i = 99; i > 0; --i) std::swap(objects[i], objects[random.below(i + 1)]);
    sortBackToFront(gpuScene, scene::View{}, objects);
    EXPECT_EQ(objects, expected);
  }
}

TEST(SortForState, GroupsByMaterialThenOrientationThenMesh) {
  scene::Scene scene;
  scene.objects = {objectAt({}, 1, 0), objectAt({}, 0, 1), objectAt({}, 0, 0), objectAt({}, 1, 0),
                   objectAt({}, 0, 0)};
  GpuScene gpuScene = gpuSceneOf(scene);
  gpuScene.mirrored[2] = true;
  std::vector<std::uint32_t> objects = {4, 3, 2, 1, 0};
  sortForState(gpuScene, objects);
  EXPECT_THAT(objects, ElementsAre(4, 1, 2, 0, 3));
}

}  // namespace
}  // namespace lucerna::render
