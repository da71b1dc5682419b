#include <gmock/gmock.h>

#include "scene/scene.hpp"
#include "scene/view.hpp"

namespace lucerna::scene {
namespace {

Scene animated(AnimationPath path, Interpolation interpolation, std::vector<float> times,
               std::vector<vec4> values) {
  Scene scene;
  addNode(scene, "still", mat4(1.f));
  addNode(scene, "moving", mat4(1.f));
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.indices = {0, 1, 2};
  scene.meshes.push_back(mesh);
  scene.objects = {{0, 0, kNone, {}}, {1, 0, kNone, {}}};
  scene.animations.push_back(
      {"a", {{1, path, interpolation, std::move(times), std::move(values)}}});
  complete(scene);
  return scene;
}

TEST(Animate, InterpolatesAndRepeats) {
  Scene scene = animated(AnimationPath::Translation, Interpolation::Linear, {0, 1, 2},
                         {{0, 0, 0, 0}, {2, 0, 0, 0}, {4, 4, 0, 0}});
  EXPECT_EQ(scene.animations[0].duration(), 2.f);
  for (const float t : {1.5f, 3.5f, -0.5f}) {
    animate(scene, t);
    EXPECT_FLOAT_EQ(scene.nodes[1].translation.x, 3.f) << t;
    EXPECT_FLOAT_EQ(scene.nodes[1].worldFromNode[3].y, 2.f) << t;
  }
  animate(scene, 2.f);  // the last pose, not the first
  EXPECT_FLOAT_EQ(scene.nodes[1].translation.x, 4.f);
}

TEST(Animate, TellsWhichObjectsMoved) {
  Scene scene = animated(AnimationPath::Translation, Interpolation::Linear, {0, 1},
                         {{0, 0, 0, 0}, {2, 0, 0, 0}});
  EXPECT_THAT(animate(scene, 0.f), testing::IsEmpty());
  EXPECT_THAT(animate(scene, 0.5f), testing::ElementsAre(1u));
  EXPECT_FLOAT_EQ(scene.objects[1].boundsW.max.x, 2.f);
  EXPECT_THAT(animate(scene, 0.5f), testing::IsEmpty());
}

TEST(Animate, RotatesAlongTheShorterArc) {
  const float h = std::sqrt(0.5f);
  Scene scene = animated(AnimationPath::Rotation, Interpolation::Linear, {0, 1},
                         {{0, 0, 0, 1}, {0, -h, 0, -h}});  // 90 degrees, sign turned over
  animate(scene, 0.5f);
  const quat expected = glm::angleAxis(0.25f * kPi, vec3(0, 1, 0));
  EXPECT_NEAR(std::abs(glm::dot(scene.nodes[1].rotation, expected)), 1.f, 1e-6f);
}

TEST(Animate, StepHoldsTheKey) {
  Scene scene = animated(AnimationPath::Scale, Interpolation::Step, {0, 1, 2},
                         {{1, 1, 1, 0}, {2, 2, 2, 0}, {3, 3, 3, 0}});
  animate(scene, 1.99f);
  EXPECT_EQ(scene.nodes[1].scale, vec3(2.f));
}

TEST(Animate, CubicSplineIsHermite) {
  // Slopes 0 at both ends: s(t) = 3t^2 - 2t^3 of the way; keys 2 s apart.
  Scene scene = animated(AnimationPath::Translation, Interpolation::CubicSpline, {0, 2},
                         {vec4(0), vec4(0), vec4(0), vec4(0), vec4(8, 0, 0, 0), vec4(0)});
  animate(scene, 0.5f);
  EXPECT_NEAR(scene.nodes[1].translation.x, 8.f * (3.f / 16.f - 2.f / 64.f), 1e-5f);
  // The out-tangent counts in units a second.
  scene.animations[0].channels[0].values[2] = vec4(1, 0, 0, 0);
  animate(scene, 1.f);
  EXPECT_NEAR(scene.nodes[1].translation.x, 4.f + 2.f * 0.125f, 1e-5f);
}

TEST(Animate, OneOfSeveralIsChosenByNameOrIndex) {
  Scene scene = animated(AnimationPath::Translation, Interpolation::Step, {0}, {{1, 0, 0, 0}});
  scene.animations.push_back(scene.animations[0]);
  scene.animations[1].name = "walk";
  scene.animations[1].channels[0].values[0] = vec4(2, 0, 0, 0);
  const auto place = [&](const std::string& choice) {
    EXPECT_TRUE(chooseAnimation(scene, choice)) << choice;
    scene.nodes[1].translation.x = 0.f;
    animate(scene, 0.f);
    return scene.nodes[1].translation.x;
  };
  EXPECT_EQ(place("walk"), 2.f);
  EXPECT_EQ(place("a"), 1.f);
  EXPECT_EQ(place("1"), 2.f);
  EXPECT_EQ(place("none"), 0.f);
  place("0");
  for (const std::string wrong : {"wlak", "2", "-1", "1x", ""}) {
    const Status chosen = chooseAnimation(scene, wrong);
    ASSERT_FALSE(chosen) << wrong;
    EXPECT_EQ(chosen.error().kind, ErrorKind::Usage);
    EXPECT_THAT(chosen.error().message, testing::HasSubstr("it has 0 'a', 1 'walk'"));
  }
  EXPECT_TRUE(scene.animations[0].playing);  // an error changes nothing
  scene.animations.clear();
  EXPECT_THAT(chooseAnimation(scene, "0").error().message, testing::HasSubstr("it has none"));
}

TEST(View, LooksAlongMinusZWithReversedDepth) {
  Scene scene;
  Camera camera;
  camera.near = 0.5f;
  camera.far = 100.f;
  camera.node = addNode(scene, "camera", glm::scale(mat4(1.f), vec3(3.f)));
  const View view = viewOf(scene, camera, 1.5f);
  const vec4 nearest = view.clipFromWorld() * vec4(0, 0, -0.5f, 1);
  const vec4 farthest = view.clipFromWorld() * vec4(0, 0, -100.f, 1);
  EXPECT_NEAR(nearest.z / nearest.w, 1.f, 1e-5f);
  EXPECT_NEAR(farthest.z / farthest.w, 0.f, 1e-5f);
}

TEST(View, ChoosesDepthAroundTheScene) {
  Scene scene = animated(AnimationPath::Scale, Interpolation::Step, {0}, {{1, 1, 1, 0}});
  Camera camera;
  camera.node = addNode(scene, "camera", glm::translate(mat4(1.f), vec3(0, 0, 50)));
  const View view = viewOf(scene, camera, 1.f);
  EXPECT_GT(view.near, 1.f);
  EXPECT_LT(view.near, 50.f);
  EXPECT_GT(view.far, 50.f);
  EXPECT_LT(view.far, 60.f);
}

TEST(View, ANarrowOutputKeepsTheCamerasWidth) {
  Scene scene;
  Camera camera;
  camera.fovY = 0.5f * kPi;
  camera.aspect = 2.f;
  camera.node = addNode(scene, "camera", mat4(1.f));
  const auto edge = [&](float aspect) {
    const vec4 clip = viewOf(scene, camera, aspect).clipFromView * vec4(2, 0, -1, 1);
    return clip.x / clip.w;
  };
  EXPECT_NEAR(edge(2.f), 1.f, 1e-5f);
  EXPECT_NEAR(edge(1.f), 1.f, 1e-5f);
  EXPECT_NEAR(edge(4.f), 0.5f, 1e-5f);
}

}  // namespace
}  // namespace lucerna::scene
