#include <gtest/gtest.h>

#include "support/testing.hpp"

namespace lucerna {
namespace {

constexpr uvec2 kSize{9, 9};

Image radiance(const scene::Scene& scene) {
  return testing::valueOf(
      scene, testing::rows({"Cull", "GBuffer", "TiledLighting", "Background", "Transparency"}),
      kSize, "Transparency.color");
}

scene::Material& addPane(scene::Scene& scene, float distance, float opacity, vec3 emissive,
                         vec3 transmission) {
  scene::Material& pane = testing::addWall(scene, distance);
  pane.alphaMode = scene::AlphaMode::Blend;
  pane.albedo = {0, 0, 0, opacity};
  pane.emissive = emissive;
  pane.transmission = transmission;
  return pane;
}

void expectNear(vec3 found, vec3 expected) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected[c], 0.01f * (0.1f + expected[c]));
}

TEST(Transparency, LetsThroughWhatTheFormulaSays) {
  scene::Scene scene = testing::emptyScene();
  testing::addWall(scene, 5.f).emissive = {1.f, 2.f, 4.f};
  addPane(scene, 3.f, 0.25f, {0.8f, 0.f, 0.f}, {1.f, 0.5f, 0.f});
  const vec3 expected =
      0.25f * vec3(0.8f, 0, 0) + scene::transmittance(0.25f, {1.f, 0.5f, 0.f}) * vec3(1, 2, 4);
  expectNear(testing::centerOf(radiance(scene)), expected);
  testing::expectNoDebugMessages();
}

TEST(Transparency, BlendsTheFarPaneFirstInWhateverOrderTheSceneHasThem) {
  for (const bool nearFirst : {false, true}) {
    scene::Scene scene = testing::emptyScene();
    for (const bool isNear : {nearFirst, !nearFirst})
      addPane(scene, isNear ? 2.f : 4.f, 0.5f, isNear ? vec3(0, 1, 0) : vec3(1, 0, 0), vec3(1.f));
    // Near: 0.5 green, and half of the far pane's 0.5 red.
    expectNear(testing::centerOf(radiance(scene)), vec3(0.25f, 0.5f, 0.f));
  }
}

TEST(Transparency, UnlitPanesKeepTheirColourInAnyLight) {
  scene::Scene scene = testing::emptyScene();
  scene.ambient = vec3(3.f);
  scene::Material& pane = addPane(scene, 3.f, 0.5f, vec3(9.f), vec3(1.f));
  pane.model = scene::MaterialModel::Unlit;
  pane.albedo = {0.5f, 0.f, 1.f, 0.5f};
  expectNear(testing::centerOf(radiance(scene)), vec3(0.25f, 0.f, 0.5f));
}

TEST(Transparency, IsHiddenByOpaqueSurfaces) {
  scene::Scene scene = testing::emptyScene();
  testing::addWall(scene, 2.f).emissive = vec3(0.5f);
  addPane(scene, 3.f, 0.5f, vec3(10.f), vec3(1.f));
  expectNear(testing::centerOf(radiance(scene)), vec3(0.5f));
}

}  // namespace
}  // namespace lucerna
