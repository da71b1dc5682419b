#include "scene/deform.hpp"

#include <gmock/gmock.h>

#include "core/parallel.hpp"
#include "core/random.hpp"
#include "scene/append.hpp"
#include "scene/scene.hpp"

namespace lucerna::scene {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr float kPi = glm::pi<float>();

// A strip along y whose lower corners follow joint 0 and whose upper corners follow joint 1.
Mesh strip() {
  Mesh mesh;
  mesh.positions = {{-1, 0, 0}, {1, 0, 0}, {1, 2, 0}, {-1, 2, 0}};
  mesh.normals.assign(4, vec3(0, 0, 1));
  mesh.tangents.assign(4, vec4(1, 0, 0, -1));
  mesh.indices = {0, 1, 2, 0, 2, 3};
  mesh.influences = {4,
                     {0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0},
                     {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}};
  return mesh;
}

// The strip as an object that stands at a node of its own; joint 1 is at (0, 2, 0).
Scene skinnedStrip() {
  Scene scene;
  scene.meshes = {strip()};
  const std::uint32_t root = addNode(scene, "root", mat4(1.f));
  Node tip;
  tip.parent = root;
  tip.translation = {0, 2, 0};
  const std::uint32_t joint = addNode(scene, tip);
  const std::uint32_t still = addNode(scene, "strip", mat4(1.f));
  scene.skins = {{"skin", {root, joint}, {mat4(1.f), glm::translate(mat4(1.f), vec3(0, -2, 0))}}};
  scene.objects = {{.node = still, .mesh = 0, .material = kNone, .boundsW = {}, .skin = 0}};
  return scene;
}

void expectNear(vec3 found, vec3 wanted) {
  EXPECT_LT(glm::distance(found, wanted), 1e-5f)
      << found.x << " " << found.y << " " << found.z << ", wanted " << wanted.x << " " << wanted.y
      << " " << wanted.z;
}

TEST(Deform, VerticesFollowTheirJointsAndBoundsFollowTheVertices) {
  Scene scene = skinnedStrip();
  complete(scene);
  const Mesh& mesh = scene.meshes[scene.objects[0].mesh];
  EXPECT_EQ(mesh.positions, strip().positions);  // as it was bound
  EXPECT_EQ(scene.objects[0].boundsW.max, vec3(1, 2, 0));

  // The tip moves up and turns a quarter about its own y: x becomes -z.
  scene.nodes[1].translation.y = 5.f;
  scene.nodes[1].rotation = glm::angleAxis(0.5f * kPi, vec3(0, 1, 0));
  updateTransforms(scene);
  expectNear(mesh.positions[1], {1, 0, 0});
  expectNear(mesh.positions[2], {0, 5, -1});
  expectNear(mesh.positions[3], {0, 5, 1});
  expectNear(mesh.normals[2], {1, 0, 0});
  expectNear(vec3(mesh.tangents[2]), {0, 0, -1});
  EXPECT_EQ(mesh.tangents[2].w, -1.f);
  expectNear(scene.objects[0].boundsW.max, {1, 5, 1});
  expectNear(scene.objects[0].boundsW.min, {-1, 0, -1});
}

TEST(Deform, JointsAreMixedByTheirWeights) {
  Scene scene = skinnedStrip();
  scene.meshes[0].influences.perVertex = 2;
  scene.meshes[0].influences.joints = {0, 1, 0, 1, 0, 1, 0, 1};
  scene.meshes[0].influences.weights = {1, 0, 1, 0, 0.25f, 0.75f, 0, 1};
  complete(scene);
  scene.nodes[1].translation = {4, 2, 0};
  updateTransforms(scene);
  const Mesh& mesh = scene.meshes[scene.objects[0].mesh];
  expectNear(mesh.positions[2], {1 + 3, 2, 0});
  expectNear(mesh.positions[3], {-1 + 4, 2, 0});
}

TEST(Deform, NormalsStaySquareToTheSurfaceUnderUnequalScales) {
  Scene scene = skinnedStrip();
  const float half = std::sqrt(0.5f);
  scene.meshes[0].normals.assign(4, vec3(half, 0, half));  // of the plane x + z = const
  complete(scene);
  scene.nodes[0].scale = {1, 1, 3};  // it becomes 3 x + z = const
  updateTransforms(scene);
  expectNear(scene.meshes[scene.objects[0].mesh].normals[0], glm::normalize(vec3(3, 0, 1)));
}

TEST(Deform, TheNodeOfTheObjectMovesNothingButItsSpace) {
  Scene scene = skinnedStrip();
  complete(scene);
  scene.nodes[2].translation = {7, 0, 0};
  updateTransforms(scene);
  const mat4& worldFromObject = scene.nodes[2].worldFromNode;
  const Mesh& mesh = scene.meshes[scene.objects[0].mesh];
  expectNear(vec3(worldFromObject * vec4(mesh.positions[2], 1.f)), {1, 2, 0});
  EXPECT_EQ(scene.objects[0].boundsW.max, vec3(1, 2, 0));
}

TEST(Deform, MeshesThatStayAsTheyAreAreNotWrittenAgain) {
  Scene scene = skinnedStrip();
  complete(scene);
  const Mesh& mesh = scene.meshes[scene.objects[0].mesh];
  const std::uint32_t version = mesh.version;
  updateTransforms(scene);
  EXPECT_EQ(mesh.version, version);
  scene.nodes[1].translation.x = 1.f;
  updateTransforms(scene);
  EXPECT_GT(mesh.version, version);
}

TEST(Deform, AnAnimatedJointMovesTheObject) {
  Scene scene = skinnedStrip();
  scene.animations.push_back({"a",
                              {{.node = 1,
                                .path = AnimationPath::Translation,
                                .interpolation = Interpolation::Linear,
                                .times = {0, 1},
                                .values = {vec4(0, 2, 0, 0), vec4(0, 6, 0, 0)},
                                .weights = {}}}});
  complete(scene);
  EXPECT_THAT(animate(scene, 0.f), IsEmpty());
  EXPECT_THAT(animate(scene, 0.5f), ElementsAre(0u));
  EXPECT_EQ(scene.objects[0].boundsW.max.y, 4.f);
  EXPECT_THAT(animate(scene, 0.5f), IsEmpty());
}

Scene morphedStrip() {
  Scene scene;
  Mesh mesh = strip();
  mesh.influences = {};
  mesh.texCoords[0] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
  mesh.colors.assign(4, u8vec4(51, 0, 0, 255));
  mesh.targets.resize(2);
  mesh.targets[0].positions = {{0, 0, 0}, {0, 0, 0}, {0, 2, 0}, {0, 2, 0}};
  mesh.targets[0].normals.assign(4, vec3(0, 1, 0));
  mesh.targets[0].texCoords[0].assign(4, vec2(0.5f, 0));
  mesh.targets[1].positions.assign(4, vec3(10, 0, 0));
  mesh.targets[1].colors.assign(4, vec4(0.2f, 2.f, 0, -0.5f));
  scene.meshes = {mesh};
  addNode(scene, "node", mat4(1.f));
  scene.objects = {{.node = 0, .mesh = 0, .material = kNone, .boundsW = {}}};
  return scene;
}

TEST(Deform, MorphTargetsAddUp) {
  Scene scene = morphedStrip();
  complete(scene);
  const Mesh& mesh = scene.meshes[scene.objects[0].mesh];
  EXPECT_EQ(mesh.positions, strip().positions);
  scene.nodes[0].weights = {1.f, 0.5f};
  updateTransforms(scene);
  expectNear(mesh.positions[0], {-1 + 5, 0, 0});
  expectNear(mesh.positions[2], {1 + 5, 4, 0});
  expectNear(mesh.normals[0], glm::normalize(vec3(0, 1, 1)));
  EXPECT_EQ(mesh.texCoords[0][0], vec2(0.5f, 1));
  EXPECT_EQ(mesh.colors[0], u8vec4(77, 255, 0, 191));  // 0.3, clamped 1, 0, 0.75
  EXPECT_EQ(scene.objects[0].boundsW.max, vec3(6, 4, 0));
  scene.nodes[0].weights = {0.f, 0.f};  // and back
  updateTransforms(scene);
  EXPECT_EQ(mesh.positions, strip().positions);
  EXPECT_EQ(mesh.texCoords[0][0], vec2(0, 1));
  EXPECT_EQ(mesh.colors[0], u8vec4(51, 0, 0, 255));
}

TEST(Deform, MorphTargetsComeBeforeTheSkin) {
  Scene scene = skinnedStrip();
  scene.meshes[0].targets.resize(1);
  scene.meshes[0].targets[0].positions.assign(4, vec3(0, 1, 0));
  scene.nodes[2].weights = {1.f};
  complete(scene);
  scene.nodes[1].rotation = glm::angleAxis(0.5f * kPi, vec3(0, 0, 1));  // y becomes -x
  updateTransforms(scene);
  expectNear(scene.meshes[scene.objects[0].mesh].positions[2], {-1, 3, 0});
}

TEST(Deform, WeightsAreAnimatedTogether) {
  Scene scene = morphedStrip();
  AnimationChannel channel;
  channel.node = 0;
  channel.path = AnimationPath::Weights;
  channel.times = {0, 2};
  channel.weights = {0, 1, 1, 0};
  scene.animations.push_back({"a", {channel}});
  complete(scene);
  EXPECT_THAT(animate(scene, 0.5f), ElementsAre(0u));
  EXPECT_THAT(scene.nodes[0].weights, ElementsAre(0.25f, 0.75f));
  scene.animations[0].channels[0].interpolation = Interpolation::Step;
  animate(scene, 1.9f);
  EXPECT_THAT(scene.nodes[0].weights, ElementsAre(0.f, 1.f));
  // Keys of (in-tangents, weights, out-tangents): flat at both ends.
  scene.animations[0].channels[0].interpolation = Interpolation::CubicSpline;
  scene.animations[0].channels[0].weights = {9, 9, 0, 1, 0, 0, 0, 0, 1, 0, 9, 9};
  animate(scene, 0.5f);
  EXPECT_NEAR(scene.nodes[0].weights[0], 3.f / 16.f - 2.f / 64.f, 1e-6f);
  EXPECT_NEAR(scene.nodes[0].weights[1], 1.f - (3.f / 16.f - 2.f / 64.f), 1e-6f);
}

TEST(Deform, FlatMeshesGetTheNormalsOfTheirBentTriangles) {
  Scene scene = morphedStrip();
  Mesh& mesh = scene.meshes[0];
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.indices = {0, 1, 2};
  mesh.normals.clear();
  mesh.tangents.clear();
  mesh.colors.clear();
  mesh.texCoords[0].clear();
  mesh.targets.resize(1);
  mesh.targets[0] = {};
  mesh.targets[0].positions = {{0, 0, 0}, {0, 0, 0}, {0, -1, 1}};
  mesh.flat = true;
  complete(scene);
  scene.nodes[0].weights = {1.f};
  updateTransforms(scene);
  for (const vec3& n : scene.meshes[scene.objects[0].mesh].normals) expectNear(n, {0, -1, 0});
}

// Finite weights times finite deltas, and inverses of finite transforms, may not be finite.
TEST(Deform, WhatWouldLeaveAllReachStaysAsItRests) {
  Scene scene = morphedStrip();
  scene.meshes[0].targets[0].positions[2] = {0, 4, 0};
  scene.meshes[0].targets[0].positions[3] = {0, -1e-9f, 0};  // beyond, but finite
  scene.meshes[0].targets[0].texCoords[0][1] = {4, 0};
  scene.meshes[0].targets[1].colors[1] = {4, -4, 0, 0};
  scene.nodes[0].weights = {1e38f, 1e38f};
  complete(scene);
  const Mesh& mesh = scene.meshes[scene.objects[0].mesh];
  EXPECT_EQ(mesh.positions, strip().positions);
  EXPECT_EQ(mesh.texCoords[0][1], vec2(1, 1));
  EXPECT_EQ(mesh.colors[1], u8vec4(51, 0, 0, 255));
  EXPECT_EQ(scene.objects[0].boundsW.max, vec3(1, 2, 0));
  EXPECT_THAT(scene.warnings, ElementsAre(HasSubstr("4 of its 4 vertices stay")));
  scene.nodes[0].weights = {1e38f, 0.f};
  updateTransforms(scene);
  EXPECT_EQ(scene.warnings.size(), 1u);  // once told is enough

  Scene skinned = skinnedStrip();
  skinned.nodes[2].scale = vec3(1e-20f);  // its inverse overflows
  complete(skinned);
  EXPECT_EQ(skinned.meshes[skinned.objects[0].mesh].positions, strip().positions);
}

// Objects with one mesh: equal skins and weights share the bent mesh, others have their own, and
// who has no skin stands at rest.
TEST(Deform, EachPoseIsAMeshOfItsOwn) {
  Scene scene = skinnedStrip();
  const std::uint32_t still = scene.objects[0].node;
  Skin other = scene.skins[0];
  std::swap(other.joints[0], other.joints[1]);
  scene.skins.push_back(other);
  scene.objects.push_back({.node = still, .mesh = 0, .material = kNone, .boundsW = {}, .skin = 1});
  scene.objects.push_back({.node = still, .mesh = 0, .material = kNone, .boundsW = {}, .skin = 0});
  scene.objects.push_back({.node = still, .mesh = 0, .material = kNone, .boundsW = {}});
  complete(scene);
  EXPECT_EQ(scene.deformations.size(), 2u);
  EXPECT_EQ(scene.objects[0].mesh, scene.objects[2].mesh);
  EXPECT_NE(scene.objects[0].mesh, scene.objects[1].mesh);
  EXPECT_EQ(scene.objects[3].mesh, 0u);
  scene.nodes[1].translation.x = 3.f;
  updateTransforms(scene);
  EXPECT_EQ(scene.meshes[0].positions, strip().positions);
  EXPECT_EQ(scene.objects[3].boundsW.max.x, 1.f);
  EXPECT_EQ(scene.objects[0].boundsW.max.x, 4.f);
  EXPECT_EQ(scene.triangleCount(), 8u);
}

// The same file included twice: each stands and bends where its include puts it.
TEST(Deform, IncludedScenesBringTheirSkins) {
  Scene scene;
  for (const float x : {10.f, 20.f}) {
    Node place;
    place.translation = {x, 0, 0};
    place.scale = vec3(2.f);
    append(scene, skinnedStrip(), place);
  }
  complete(scene);
  ASSERT_EQ(scene.objects.size(), 2u);
  scene.nodes[scene.skins[1].joints[1]].translation.y = 3.f;
  updateTransforms(scene);
  expectNear(scene.objects[0].boundsW.max, {12, 4, 0});
  expectNear(scene.objects[1].boundsW.max, {22, 6, 0});
}

// Tangents split vertices; whoever joins the mesh's streams later must find them all as long.
TEST(Deform, VerticesThatTangentsSplitKeepTheirJoints) {
  Mesh mesh = strip();
  mesh.tangents.clear();
  mesh.texCoords[0] = {{0, 0}, {1, 0}, {0.5f, 1}, {1, 0}};  // mirrored across the diagonal
  mesh.targets.resize(1);
  mesh.targets[0].positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}};
  mesh.indices = {0, 1, 2, 0, 2, 3};
  makeTangents(mesh, 0);
  ASSERT_GT(mesh.positions.size(), 4u);
  EXPECT_EQ(mesh.targets[0].positions.size(), mesh.positions.size());
  ASSERT_EQ(mesh.influences.joints.size(), 4 * mesh.positions.size());
  ASSERT_EQ(mesh.influences.weights.size(), 4 * mesh.positions.size());
  for (std::size_t i = 4; i < mesh.positions.size(); ++i) {
    const auto original = static_cast<std::size_t>(mesh.targets[0].positions[i].x);
    EXPECT_EQ(mesh.positions[i], mesh.positions[original]);
    EXPECT_EQ(mesh.influences.joints[4 * i], mesh.influences.joints[4 * original]);
  }
}

TEST(Deform, GivesTheSameBitsWhateverTheNumberOfThreads) {
  Random random(3);
  Mesh rest;
  constexpr std::uint32_t kCount = 20000;
  for (std::uint32_t i = 0; i < kCount; ++i) {
    rest.positions.emplace_back(random.uniform(-1, 1), random.uniform(-1, 1),
                                random.uniform(-1, 1));
    rest.normals.push_back(glm::normalize(rest.positions.back() + vec3(0, 0, 3)));
    rest.indices.push_back(i);
    for (int k = 0; k < 2; ++k) {
      rest.influences.joints.push_back(static_cast<std::uint16_t>(random.below(8)));
      rest.influences.weights.push_back(k == 0 ? 0.7f : 0.3f);
    }
  }
  rest.influences.perVertex = 2;
  rest.indices.resize(kCount / 3 * 3);
  std::vector<mat4> joints;
  for (int i = 0; i < 8; ++i)
    joints.push_back(glm::rotate(mat4(1.f), random.uniform(-3, 3), vec3(0.6f, 0.8f, 0)));
  const auto bentBy = [&](int threads) {
    setThreadCount(threads);
    Mesh bent = rest;
    bend(rest, {}, joints, bent);
    setThreadCount(0);
    return bent;
  };
  const Mesh one = bentBy(1), four = bentBy(4);
  EXPECT_EQ(one.positions, four.positions);
  EXPECT_EQ(one.normals, four.normals);
  EXPECT_EQ(one.bounds.min, four.bounds.min);
  EXPECT_EQ(one.bounds.max, four.bounds.max);
}

}  // namespace
}  // namespace lucerna::scene
