// What ShadowMaps draws, and for whom.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "support/testing.hpp"

namespace lucerna {
namespace {

constexpr uvec2 kSize{65, 65};  // odd: the middle pixel looks along the axis
const std::vector<std::string> kRows{"Cull", "GBuffer", "ShadowMaps", "TiledLighting"};

// A wall before the camera of emptyScene(), 6 m away.
scene::Scene wallScene() {
  scene::Scene scene = testing::emptyScene();
  testing::addWall(scene, 6.f);
  return scene;
}

void addCube(scene::Scene& scene, vec3 center) {
  testing::addBox(scene, center, vec3(0.5f));
}

void addLamp(scene::Scene& scene, scene::LightKind kind, vec3 eye, vec3 target) {
  scene::Light light;
  light.kind = kind;
  light.intensity = 100.f;
  testing::addLight(scene, light, eye, target);
  updateTransforms(scene);
}

// One more frame. picture: TiledLighting's, if it is wanted.
graph::StepProfile profileOf(testing::SceneRenderer& renderer, const graph::Pipeline& pipeline,
                             Image* picture = nullptr) {
  renderer.profiling = true;
  auto output = renderer.render(pipeline, kSize, {"TiledLighting.color"});
  CHECK(static_cast<bool>(output), "{}", output.error().message);
  if (picture) *picture = std::move(output->kept.at("TiledLighting.color"));
  for (const graph::StepProfile& step : output->profile.steps)
    if (step.row == "ShadowMaps") return step;
  ADD_FAILURE() << "ShadowMaps did not run";
  return {};
}
graph::StepProfile profileOf(const scene::Scene& scene, const graph::Pipeline& pipeline) {
  testing::SceneRenderer renderer(scene);
  return profileOf(renderer, pipeline);
}

// Only what lies between the lights and what is seen is drawn.
TEST(ShadowMaps, CastersAreCulledFromTheLight) {
  scene::Scene scene = wallScene();
  for (int i = 0; i < 40; ++i) addCube(scene, {20.f + static_cast<float>(i), 0, -4});
  addCube(scene, {0, 0, -4});
  addLamp(scene, scene::LightKind::Directional, {0, 3, 0}, {0, 0, -4});
  EXPECT_EQ(profileOf(scene, testing::rows(kRows)).counters.primitives, 2u * 12u)
      << "the wall and one cube";
}

TEST(ShadowMaps, FacesOfALampThatNobodySeesAreNotDrawn) {
  scene::Scene scene = wallScene();
  addLamp(scene, scene::LightKind::Point, {0, 0, -3}, {0, 0, -4});
  const std::uint64_t before = profileOf(scene, testing::rows(kRows)).counters.primitives;
  EXPECT_GE(before, 12u);
  EXPECT_LT(before, 6u * 12u) << "the wall is seen by one face, and its ends by a few more";
  addLamp(scene, scene::LightKind::Spot, {0, 0, 5}, {0, 0, 9});
  EXPECT_EQ(profileOf(scene, testing::rows(kRows)).counters.primitives, before)
      << "a lamp that shines away";
}

TEST(ShadowMaps, LampsBeyondTheBudgetLightWithoutShadows) {
  scene::Scene scene = wallScene();
  addCube(scene, {0, 0, 2});
  addLamp(scene, scene::LightKind::Point, {0, 0, 4}, {0, 0, -1});
  graph::Pipeline pipeline = testing::rows(kRows);
  const auto center = [&] {
    return testing::centerOf(testing::valueOf(scene, pipeline, kSize, "TiledLighting.color"));
  };
  EXPECT_EQ(center(), vec3(0.f));
  pipeline.passes[2].params["localLights"] = std::int64_t{0};
  EXPECT_GT(center().y, 0.01f);
}

TEST(ShadowMaps, WhatIsInsideALampThrowsNoShadow) {
  scene::Scene scene = wallScene();
  addCube(scene, {0, 0, -2});  // half a metre wide
  addLamp(scene, scene::LightKind::Point, {0, 0, -2}, {0, 0, -3});
  const auto center = [&] {
    return testing::centerOf(
        testing::valueOf(scene, testing::rows(kRows), kSize, "TiledLighting.color"));
  };
  scene.nodes[scene.objects.back().node].translation.x += 2.f;  // out of the picture's middle
  scene.nodes[scene.lights.back().node].translation.x += 2.f;
  updateTransforms(scene);
  EXPECT_EQ(center(), vec3(0.f));
  scene.lights.back().radius = 0.25f;  // the cube touches its surface
  EXPECT_GT(center().y, 0.01f);
}

TEST(ShadowMaps, AreDrawnAnewWhereSomethingHasChanged) {
  for (const scene::LightKind kind : {scene::LightKind::Directional, scene::LightKind::Spot}) {
    scene::Scene scene = wallScene();
    addCube(scene, {0, 0, 2});
    addLamp(scene, kind, {0.5f, 1, 4}, {0, 0, -4});
    testing::SceneRenderer renderer(scene);
    graph::Pipeline pipeline = testing::rows(kRows);
    Image first, again, moved, fresh;
    EXPECT_GT(profileOf(renderer, pipeline, &first).counters.draws, 0u);
    EXPECT_EQ(profileOf(renderer, pipeline, &again).counters.draws, 0u);
    EXPECT_TRUE(std::ranges::equal(first.bytes(), again.bytes()));

    const auto cube = static_cast<std::uint32_t>(scene.objects.size() - 1);
    scene.nodes[scene.objects[cube].node].translation.x += 0.4f;
    updateTransforms(scene);
    updateMoved(testing::device(), renderer.gpuScene, std::array{cube});
    EXPECT_GT(profileOf(renderer, pipeline, &moved).counters.draws, 0u);
    EXPECT_FALSE(std::ranges::equal(first.bytes(), moved.bytes()));
    testing::SceneRenderer anew(scene);
    profileOf(anew, pipeline, &fresh);
    EXPECT_TRUE(std::ranges::equal(fresh.bytes(), moved.bytes()));

    pipeline.passes[2].params["redraw"] = std::string("always");
    EXPECT_GT(profileOf(renderer, pipeline, &again).counters.draws, 0u);
    EXPECT_GT(profileOf(renderer, pipeline, &again).counters.draws, 0u);
  }
}

// A lamp on a bare wall shares a layer with one that is walled in: filters that reach past the edge
// of the first one's maps must not meet the walls in the other's.
TEST(ShadowMaps, FiltersDoNotReachOtherMapsOfALayer) {
  scene::Scene scene = wallScene();
  addLamp(scene, scene::LightKind::Point, {0.3f, 0.2f, -4.5f}, {0, 0, -5});
  updateTransforms(scene);
  const auto picture = [&](const graph::Pipeline& pipeline) {
    return testing::asFloatRgb(testing::valueOf(scene, pipeline, kSize, "TiledLighting.color"));
  };
  const Image bare = picture(testing::rows({"Cull", "GBuffer", "TiledLighting"}));
  addCube(scene, {0, 0, 3});
  addLamp(scene, scene::LightKind::Point, {0, 0, 3}, {0, 0, 2});
  graph::Pipeline pipeline = testing::rows(kRows);
  pipeline.passes[2].params["localMemory"] = std::int64_t{1};
  pipeline.passes[3].params["shadows"] = std::string("pcf");
  for (const std::int64_t kernel : {3, 11, 47})
    for (const char* comparison : {"nearest", "filtered"}) {
      pipeline.passes[3].params["kernel"] = kernel;
      pipeline.passes[3].params["comparison"] = std::string(comparison);
      const Image found = picture(pipeline);
      float worst = 0.f;
      for (std::size_t i = 0; i < bare.as<float>().size(); ++i)
        worst = std::max(worst, std::abs(bare.as<float>()[i] - found.as<float>()[i]));
      EXPECT_LE(worst, 1.f / 255.f) << comparison << ' ' << kernel;
    }
}

TEST(ShadowMaps, SizesAreThoseAskedFor) {
  scene::Scene scene = wallScene();
  addLamp(scene, scene::LightKind::Directional, {0, 3, 0}, {0, 0, -4});
  graph::Pipeline pipeline = testing::rows(kRows);
  for (const std::int64_t size : {64, 1000, 8192}) {
    pipeline.passes[2].params["size"] = size;
    const std::uint64_t before = testing::device().objectCounts().textureBytes;
    testing::SceneRenderer renderer(scene);
    ASSERT_TRUE(renderer.render(pipeline, kSize));
    const std::uint64_t bytes = testing::device().objectCounts().textureBytes - before;
    EXPECT_GE(bytes, static_cast<std::uint64_t>(size * size * 4));
    EXPECT_LT(bytes, static_cast<std::uint64_t>(size * size * 4) + 1'000'000);
  }
}

}  // namespace
}  // namespace lucerna
