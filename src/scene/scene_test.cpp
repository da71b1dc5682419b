// Transforms, bounds, normals, tangents, and what complete() adds.
#include "scene/scene.hpp"

#include <gmock/gmock.h>

#include <algorithm>

#include "core/test_folder.hpp"
#include "image/image_file.hpp"
#include "scene/append.hpp"
#include "scene/texture_store.hpp"
#include "scene/view.hpp"

namespace lucerna::scene {
namespace {

::testing::AssertionResult near(vec3 a, vec3 b, float tolerance = 1e-5f) {
  if (glm::length(a - b) <= tolerance) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure()
         << fmt::format("({}, {}, {}) is not near ({}, {}, {})", a.x, a.y, a.z, b.x, b.y, b.z);
}

// A unit square in the plane z = 0, facing +z; u to the right, v downwards.
Mesh square() {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.texCoords[0] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
  mesh.indices = {0, 1, 2, 0, 2, 3};
  return mesh;
}

// The inside of a room of 8 x 4 x 8 m around the origin.
Mesh room() {
  Mesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.positions.emplace_back((i & 1) ? 4 : -4, (i & 2) ? 2 : -2, (i & 4) ? 4 : -4);
  mesh.indices = {0, 1, 2, 1, 3, 2, 4, 6, 5, 5, 6, 7, 0, 2, 4, 2, 6, 4,
                  1, 5, 3, 3, 5, 7, 0, 4, 1, 1, 4, 5, 2, 3, 6, 3, 7, 6};
  return mesh;
}

// The other sides of its triangles.
Mesh turned(Mesh mesh) {
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
    std::swap(mesh.indices[i], mesh.indices[i + 1]);
  return mesh;
}

Scene sceneOf(Mesh mesh) {
  Scene scene;
  scene.meshes.push_back(std::move(mesh));
  addNode(scene, "root", mat4(1.f));
  scene.objects.push_back({0, 0, kNone, {}});
  return scene;
}

TEST(Transforms, ChildrenFollowTheirParents) {
  Scene scene;
  Node parent;
  parent.translation = {1, 0, 0};
  parent.rotation = glm::angleAxis(0.5f * kPi, vec3(0, 1, 0));
  Node child;
  child.parent = addNode(scene, parent);
  child.translation = {0, 0, 2};
  child.scale = vec3(3.f);
  addNode(scene, child);
  updateTransforms(scene);
  EXPECT_TRUE(near(vec3(scene.nodes[1].worldFromNode * vec4(1, 0, 0, 1)), {3, 0, -3}));
}

TEST(Transforms, AMatrixWithShearIsKept) {
  mat4 shear(1.f);
  shear[1][0] = 0.5f;
  Node node;
  setLocalTransform(node, shear);
  ASSERT_TRUE(node.matrix.has_value());
  EXPECT_EQ(node.parentFromNode(), shear);
}

TEST(Transforms, AMirroredMatrixComesBackFromItsParts) {
  mat4 m = glm::rotate(mat4(1.f), 1.f, glm::normalize(vec3(1, 2, 3)));
  m = glm::scale(m, vec3(-2, 3, 4));
  m[3] = vec4(5, 6, 7, 1);
  Node node;
  setLocalTransform(node, m);
  ASSERT_FALSE(node.matrix.has_value());
  for (int i = 0; i < 4; ++i)
    EXPECT_TRUE(near(vec3(node.parentFromNode()[i]), vec3(m[i]), 1e-4f)) << i;
}

TEST(Transforms, BoxesOfObjectsMove) {
  Scene scene = sceneOf(square());
  complete(scene);
  scene.nodes[0].translation = {10, 0, 0};
  updateTransforms(scene);
  EXPECT_TRUE(near(scene.objects[0].boundsW.min, {10, 0, 0}));
  EXPECT_TRUE(near(scene.boundsW().max, {11, 1, 0}));
}

TEST(Normals, AreWeightedByArea) {
  Mesh mesh;
  // Two triangles share an edge; one is four times as large.
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 4}};
  mesh.indices = {0, 1, 2, 0, 3, 1};
  makeNormals(mesh);
  EXPECT_TRUE(near(mesh.normals[0], glm::normalize(vec3(0, 4, 1))));
  EXPECT_TRUE(near(mesh.normals[2], {0, 0, 1}));
}

TEST(Normals, OfDegenerateTrianglesAreStillUnit) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
  mesh.indices = {0, 1, 2};
  makeNormals(mesh);
  for (const vec3 n : mesh.normals) EXPECT_FLOAT_EQ(glm::length(n), 1.f);
}

TEST(Tangents, FollowUAndPointUpTheImage) {
  Mesh mesh = square();
  makeNormals(mesh);
  makeTangents(mesh, 0);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    EXPECT_TRUE(near(vec3(mesh.tangents[i]), {1, 0, 0}));
    const vec3 up = glm::cross(mesh.normals[i], vec3(mesh.tangents[i])) * mesh.tangents[i].w;
    EXPECT_TRUE(near(up, {0, 1, 0}));
  }
}

TEST(Tangents, AVertexBetweenMirroredHalvesIsSplit) {
  Mesh mesh = square();
  // A second square to the left that shares an edge and runs u the other way.
  mesh.positions.insert(mesh.positions.end(), {{-1, 0, 0}, {-1, 1, 0}});
  mesh.texCoords[0].insert(mesh.texCoords[0].end(), {{1, 1}, {1, 0}});
  mesh.indices.insert(mesh.indices.end(), {4, 0, 3, 4, 3, 5});
  makeNormals(mesh);
  makeTangents(mesh, 0);
  EXPECT_EQ(mesh.positions.size(), 8u);
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t v = mesh.indices[3 * t + k];
      EXPECT_TRUE(near(vec3(mesh.tangents[v]), {t < 2 ? 1.f : -1.f, 0, 0}));
      EXPECT_EQ(mesh.tangents[v].w, t < 2 ? 1.f : -1.f);
    }
}

TEST(Complete, AddsMaterialLightAndCameraWhereThereAreNone) {
  Scene scene = sceneOf(square());
  complete(scene);
  ASSERT_EQ(scene.materials.size(), 1u);
  EXPECT_EQ(scene.materials[0].metallic, 0.f);
  EXPECT_FLOAT_EQ(scene.materials[0].albedo.x, 0.8f);
  EXPECT_EQ(scene.objects[0].material, 0u);
  ASSERT_EQ(scene.cameras.size(), 1u);
  ASSERT_EQ(scene.lights.size(), 1u);
  EXPECT_EQ(scene.lights[0].node, scene.cameras[0].node);
  EXPECT_FLOAT_EQ(scene.lights[0].intensity, 0.8f * kPi);
  EXPECT_FLOAT_EQ(scene.ambient.x, 0.2f);
  EXPECT_EQ(scene.meshes[0].normals.size(), 4u);
}

TEST(Complete, AddsNoHeadlightToAmbientLight) {
  Scene scene = sceneOf(square());
  scene.ambient = vec3(0.05f);
  complete(scene);
  EXPECT_THAT(scene.lights, testing::IsEmpty());
  EXPECT_EQ(scene.headlight, kNone);
  EXPECT_EQ(scene.ambient, vec3(0.05f));
}

TEST(Complete, LeavesAloneWhatThereIs) {
  Scene scene = sceneOf(square());
  scene.materials.resize(1);
  scene.objects[0].material = 0;
  scene.lights.emplace_back().node = 0;
  scene.cameras.emplace_back().node = 0;
  scene.meshes[0].normals.assign(4, vec3(1, 0, 0));
  complete(scene);
  EXPECT_EQ(scene.materials.size(), 1u);
  EXPECT_EQ(scene.lights.size(), 1u);
  EXPECT_EQ(scene.cameras.size(), 1u);
  EXPECT_EQ(scene.ambient, vec3(0.f));
  EXPECT_EQ(scene.meshes[0].normals[0], vec3(1, 0, 0));
}

TEST(Complete, MakesTangentsOnlyWhereANormalMapIsUsed) {
  Scene scene = sceneOf(square());
  complete(scene);
  EXPECT_TRUE(scene.meshes[0].tangents.empty());
  scene.materials[0].normalTexture.texture = 0;
  complete(scene);
  EXPECT_EQ(scene.meshes[0].tangents.size(), 4u);
}

// Cards, a tower and a plank, in outputs of any shape; and as large as fits.
TEST(Complete, TheCameraSeesTheWholeBox) {
  for (const vec2 shape :
       {vec2(0.01f), vec2(1.f), vec2(3000.f), vec2(1.f, 40.f), vec2(40.f, 1.f)}) {
    Mesh mesh = square();
    for (vec3& p : mesh.positions) p = vec3(shape, shape.x) * (p + vec3(5, 0, 0.3f * p.x));
    Scene scene = sceneOf(std::move(mesh));
    complete(scene);
    for (const float aspect : {1.f / 3.f, 1.f, 4.f / 3.f, 3.f}) {
      const View view = viewOf(scene, scene.cameras[0], aspect);
      float reach = 0.f;  // 1 at the border of the picture
      for (const vec3 p : scene.meshes[0].positions) {
        const vec4 clip = view.clipFromWorld() * vec4(p, 1.f);
        reach = std::max({reach, std::abs(clip.x / clip.w), std::abs(clip.y / clip.w)});
        EXPECT_GT(clip.z, 0.f);
        EXPECT_LT(clip.z, clip.w);
      }
      EXPECT_LE(reach, 1.f) << shape.x << " x " << shape.y << " m, aspect " << aspect;
      EXPECT_GT(reach, 0.4f) << shape.x << " x " << shape.y << " m, aspect " << aspect;
    }
  }
}

TEST(Complete, InARoomTheCameraStandsInside) {
  for (const bool inside : {true, false}) {
    Scene scene = sceneOf(inside ? room() : turned(room()));
    complete(scene);
    const vec3 eye(scene.nodes[scene.cameras[0].node].worldFromNode[3]);
    const Aabb box = scene.boundsW();
    const bool isInside = eye.x > box.min.x && eye.x < box.max.x && eye.y > box.min.y &&
                          eye.y < box.max.y && eye.z > box.min.z && eye.z < box.max.z;
    EXPECT_EQ(isInside, inside);
  }
}

TEST(Complete, AGapBetweenThingsInAFieldIsNoRoom) {
  Mesh field;  // 200 x 200 m, and four walls that face its middle from 0.4 m
  for (const float half : {100.f, 0.4f})
    for (int i = 0; i < 8; ++i)
      field.positions.emplace_back((i & 1) ? half : -half, (i & 2) ? 2.f : 0.f,
                                   (i & 4) ? half : -half);
  field.indices = {0, 4, 1, 1, 4, 5};
  for (const std::uint32_t corner :
       {0, 1, 2, 1, 3, 2, 4, 6, 5, 5, 6, 7, 0, 2, 4, 2, 6, 4, 1, 5, 3, 3, 5, 7})
    field.indices.push_back(8 + corner);
  Scene scene = sceneOf(std::move(field));
  complete(scene);
  const vec3 eye(scene.nodes[scene.cameras[0].node].worldFromNode[3]);
  EXPECT_GT(eye.y, 2.f);
}

// Walls of three sheets: where the camera stands may not depend on which is met first, as it would
// on the threads.
TEST(Complete, TheCameraDoesNotDependOnTheOrderOfTheSurfaces) {
  struct Sheet {
    float size;
    bool inward;
  };
  const auto cameraIn = [](const std::vector<Sheet>& sheets) {
    Scene scene;
    for (const auto& [size, inward] : sheets) {
      const auto mesh = static_cast<std::uint32_t>(scene.meshes.size());
      scene.meshes.push_back(inward ? room() : turned(room()));
      const std::uint32_t node =
          addNode(scene, "wall", glm::scale(mat4(1.f), vec3(size, 1.f, size)));
      scene.objects.push_back({.node = node, .mesh = mesh, .material = kNone, .boundsW = {}});
    }
    complete(scene);
    return scene.nodes[scene.cameras[0].node].worldFromNode;
  };
  const Sheet inner{1.f, false}, middle{1.00008f, true}, outer{1.00015f, false};
  const mat4 camera = cameraIn({inner, middle, outer});
  EXPECT_LT(glm::length(vec3(camera[3])), 8.f);  // inside
  EXPECT_EQ(cameraIn({outer, middle, inner}), camera);
  EXPECT_EQ(cameraIn({middle, outer, inner}), camera);
}

TEST(Complete, WhatLiesBeyondReachDoesNotCountForTheView) {
  Scene scene;
  scene.meshes.push_back(room());
  for (const float far : {0.f, 1e37f, 1e20f}) {
    Node node;
    node.translation.x = far;
    node.scale = vec3(far == 1e37f ? 1e38f : 1.f);
    scene.objects.push_back(
        {.node = addNode(scene, node), .mesh = 0, .material = kNone, .boundsW = {}});
  }
  complete(scene);
  EXPECT_THAT(scene.warnings,
              testing::ElementsAre(testing::HasSubstr("2 of 3 objects lie so far")));
  const View view = viewOf(scene, scene.cameras[0], 1.f);
  EXPECT_LT(view.near, 1.f);
  EXPECT_LT(view.far, 100.f);
}

TEST(TextureStore, RefusesWhatIsTooMuchTogether) {
  const TestFolder folder;
  TextureStore store;
  int side = 0;
  for (const char* name : {"a.png", "b.png", "c.png"}) {  // 1, 4 and 9 pixels
    ++side;
    ASSERT_TRUE(writeImage(folder / name, Image(side, side, 4, ComponentType::U8)));
    store.addFile(folder / name);
  }
  std::vector<std::string> warnings;
  // 12 bytes a pixel
  ASSERT_TRUE(writeImage(folder / "d.hdr", Image(2, 2, 3, ComponentType::F32)));
  store.addFile(folder / "d.hdr");
  const auto images = store.load(warnings, 57);
  EXPECT_EQ(images[1]->width(), 2);
  EXPECT_EQ(images[2]->width(), 3);
  EXPECT_EQ(images[3], checkerboard());
  EXPECT_THAT(warnings, testing::ElementsAre(testing::AllOf(
                            testing::HasSubstr("d.hdr is replaced"),
                            testing::HasSubstr("takes 48 B, and with it the textures take more "
                                               "than 57 B together"))));
}

TEST(Append, TheFirstPartGivesBackgroundAndExposure) {
  Scene scene;
  for (const float exposure : {1.f, 2.f}) {
    Scene part = sceneOf(square());
    part.exposure = exposure;
    part.background.color = vec3(exposure);
    append(scene, part, Node{});
  }
  EXPECT_EQ(scene.exposure, 1.f);
  EXPECT_EQ(scene.background.color, vec3(1.f));
}

TEST(Append, ShiftsIndicesAndPlacesThePart) {
  Scene scene = sceneOf(square());
  scene.materials.resize(1);
  Scene part = sceneOf(square());
  part.materials.resize(2);
  part.objects[0].material = 1;
  part.lights.emplace_back().node = 0;
  Node place;
  place.translation = {0, 5, 0};
  append(scene, part, place);
  updateTransforms(scene);
  ASSERT_EQ(scene.objects.size(), 2u);
  EXPECT_EQ(scene.objects[1].mesh, 1u);
  EXPECT_EQ(scene.objects[1].material, 2u);
  EXPECT_TRUE(near(vec3(scene.nodes[scene.objects[1].node].worldFromNode[3]), {0, 5, 0}));
  EXPECT_TRUE(near(placeLights(scene)[0].positionW, {0, 5, 0}));
}

}  // namespace
}  // namespace lucerna::scene
