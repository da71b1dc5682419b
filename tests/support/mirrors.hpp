// What the tests of Mirrors share: sheets before a camera, and pictures of them.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/testing.hpp"

namespace lucerna {

inline constexpr uvec2 kSize{64, 64};

// Rows that reflect, and the same without.
inline graph::Pipeline reflecting(std::int64_t depth = 4) {
  graph::Pipeline pipeline =
      testing::rows({"Cull", "Forward", "Background", "Mirrors", "Transparency", "ToneMap"});
  pipeline.passes[3].params = {{"depth", depth}};
  return pipeline;
}
inline graph::Pipeline plain() {
  return testing::rows({"Cull", "Forward", "Background", "Transparency", "ToneMap"});
}

// Linear radiance, F32.
inline Image radiance(const scene::Scene& scene, const graph::Pipeline& pipeline,
                      uvec2 size = kSize) {
  return testing::asFloatRgb(testing::valueOf(scene, pipeline, size, "Transparency.color"));
}

inline vec3 at(const Image& radiance, int x, int y) {
  const float* pixel = radiance.pixel<float>(x, y);
  return {pixel[0], pixel[1], pixel[2]};
}
inline vec3 middleOf(const Image& radiance) {
  return at(radiance, radiance.width() / 2, radiance.height() / 2);
}

// But for the rounding of half floats.
inline ::testing::AssertionResult near(vec3 found, vec3 expected) {
  if (glm::distance(found, expected) < 2e-3f) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << found.x << ", " << found.y << ", " << found.z;
}

inline bool equal(const Image& a, const Image& b) {
  return std::ranges::equal(a.bytes(), b.bytes());
}

// A square of side 1 in the plane z = 0 that faces +z.
inline scene::Mesh sheetMesh() {
  scene::Mesh mesh;
  mesh.positions = {{-0.5f, -0.5f, 0}, {0.5f, -0.5f, 0}, {0.5f, 0.5f, 0}, {-0.5f, 0.5f, 0}};
  mesh.normals.assign(4, vec3(0, 0, 1));
  mesh.indices = {0, 1, 2, 0, 2, 3};
  for (const vec3& position : mesh.positions) mesh.bounds.grow(position);
  return mesh;
}

// Places what looks along +z at `at`, looking towards `direction`.
inline mat4 facing(vec3 at, vec3 direction, vec3 size = vec3(1.f)) {
  const vec3 up = std::abs(direction.y) > 0.9f ? vec3(0, 0, 1) : vec3(0, 1, 0);
  return glm::scale(glm::inverse(glm::lookAt(at, at - direction, up)), size);
}

class Mirrors : public ::testing::Test {
 protected:
  Mirrors() : scene_(testing::emptyScene()) { scene_.meshes.push_back(sheetMesh()); }
  void TearDown() override { testing::expectNoDebugMessages(); }

  // A sheet with a material of its own.
  scene::Material& addSheet(const mat4& place) { return add(1, place); }
  scene::Material& addCube(const mat4& place) { return add(0, place); }
  // A sheet that shows one colour in any light.
  void addCard(const mat4& place, vec3 color) {
    scene::Material& card = addSheet(place);
    card.model = scene::MaterialModel::Unlit;
    card.albedo = vec4(color, 1.f);
  }
  // The mirror that the camera looks at: 4 m ahead, 4 m wide, black without a reflection.
  scene::Material& addMirror(const mat4& place = facing({0, 0, -4}, {0, 0, 1}, vec3(4.f))) {
    scene::Material& mirror = addSheet(place);
    mirror.reflectivity = 1.f;
    mirror.albedo = vec4(0, 0, 0, 1);
    mirror.metallic = 0.f;
    return mirror;
  }
  vec3 middle(const graph::Pipeline& pipeline = reflecting()) const {
    return middleOf(radiance(scene_, pipeline));
  }

  scene::Scene scene_;

 private:
  scene::Material& add(std::uint32_t mesh, const mat4& place) {
    scene_.materials.emplace_back();
    testing::addObject(scene_, mesh, static_cast<std::uint32_t>(scene_.materials.size() - 1),
                       place);
    updateTransforms(scene_);
    return scene_.materials.back();
  }
};

}  // namespace lucerna
