#include "passes/cull/cull.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/testing.hpp"

namespace lucerna::passes {
namespace {

using ::testing::ElementsAre;

TEST(CullLists, HoldObjectsByTheirMaterialMirrorsApart) {
  scene::Scene scene = testing::emptyScene();
  const auto add = [&](scene::AlphaMode mode, float reflectivity) {
    scene::Material& material = testing::addWall(scene, 3.f);
    material.alphaMode = mode;
    material.reflectivity = reflectivity;
  };
  add(scene::AlphaMode::Opaque, 0.f);
  add(scene::AlphaMode::Mask, 0.f);
  add(scene::AlphaMode::Blend, 0.f);
  add(scene::AlphaMode::Opaque, 1.f);
  add(scene::AlphaMode::Mask, 0.3f);
  add(scene::AlphaMode::Blend, 1.f);  // translucent surfaces are no mirrors
  testing::SceneRenderer renderer(scene);
  updateView(testing::device(), renderer.view, viewOf(scene, scene.cameras[0], 1.f), {8, 8});
  render::DrawLists lists;
  Cull::Ports ports;
  ports.scene.bind(&renderer.gpuScene);
  ports.view.bind(&renderer.view);
  ports.drawLists.bind(&lists);
  graph::PassContext context{.device = testing::device()};
  Cull(testing::device()).execute(context, {}, ports);
  EXPECT_THAT(lists.opaque.objects, ElementsAre(0));
  EXPECT_THAT(lists.alphaTested.objects, ElementsAre(1));
  EXPECT_THAT(lists.transparent.objects, ElementsAre(2, 5));
  EXPECT_THAT(lists.mirrors.objects, ElementsAre(3, 4));
}

// Without a pass that reflects in them, mirrors show their own material.
TEST(CullLists, LetMirrorsBeDrawnAsTheirOwnMaterial) {
  scene::Scene scene = testing::sampleScene();
  for (const auto& rows : {testing::kDeferredRows, testing::kForwardRows}) {
    const Image expected = testing::pictureOf(scene, testing::rows(rows), {160, 90});
    for (const std::size_t material : {1u, 2u, 3u}) scene.materials[material].reflectivity = 0.8f;
    const Image found = testing::pictureOf(scene, testing::rows(rows), {160, 90});
    EXPECT_TRUE(std::ranges::equal(found.bytes(), expected.bytes())) << rows[1];
    for (scene::Material& material : scene.materials) material.reflectivity = 0.f;
  }
  testing::expectNoDebugMessages();
}

}  // namespace
}  // namespace lucerna::passes
