// What is no triangle, or reaches too far, changes nothing about the light on the rest.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "bake/light_scenes.hpp"
#include "bake/unit_light.hpp"
#include "image/image.hpp"

namespace lucerna::bake {
namespace {

using namespace testing;
using scene::LightKind;

// A floor below a roof, in the sun and beside a lamp, and triangles of an object of their own.
scene::Scene sheltered(const std::vector<std::array<vec3, 3>>& triangles) {
  scene::Scene scene = trace::testing::emptyScene();
  addSurface(scene);
  addRectangle(scene, vec3(0), vec3(0, 0, 2), vec3(2, 0, 0));
  addRectangle(scene, vec3(0, 1, 0), vec3(0, 0, 1), vec3(1, 0, 0));
  addLight(scene, LightKind::Directional, vec3(0, 10, 0), vec3(0.1f, -1, 0.2f)).intensity = 1.f;
  addLight(scene, LightKind::Point, vec3(0.5f, 3, 0), vec3(0, -1, 0)).intensity = 2.f;
  if (!triangles.empty()) addRectangle(scene, vec3(0), vec3(0, 0, 1), vec3(1, 0, 0));
  if (triangles.empty()) return scene;
  scene::Mesh& mesh = scene.meshes[scene.objects.back().mesh];
  mesh = {};
  for (const auto& corners : triangles)
    for (const vec3 corner : corners) {
      mesh.indices.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
      mesh.positions.push_back(corner);
    }
  return scene;
}

std::vector<LitTexel> floorOf(const scene::Scene& scene, Unwrap unwrap) {
  LightOptions options;
  options.unwrap = unwrap;
  return texelsOf(lightAll(planOf(scene, options)), 0);
}

TEST(OddTriangles, ChangeNoLight) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN(),
                  kInf = std::numeric_limits<float>::infinity();
  const std::vector<std::array<vec3, 3>> odd{
      {vec3(0, 5, 0), vec3(1e30f, 5, 0), vec3(0, 5, 1)},
      {vec3(-1e30f, 5, -1e30f), vec3(1e30f, 5, -1e30f), vec3(0, 5, 1e30f)},
      {vec3(0, 5, 0), vec3(2e6f, 5, 0), vec3(0, 5, 1)},
      {vec3(0, 5, 0), vec3(kInf, 5, 0), vec3(0, 5, 1)},
      {vec3(kNan), vec3(kNan), vec3(kNan)},
      {vec3(0, 2, 0), vec3(kNan, 2, 0), vec3(0, 2, 1)},
      {vec3(0, 2, 0), vec3(0, 2, 0), vec3(1, 2, 0)},
      {vec3(0, 2, 0), vec3(1, 2, 0), vec3(2, 2, 0)}};
  for (const Unwrap unwrap : {Unwrap::Charts, Unwrap::Pairs}) {
    const auto wanted = floorOf(sheltered({}), unwrap), found = floorOf(sheltered(odd), unwrap);
    ASSERT_EQ(found.size(), wanted.size());
    std::size_t dark = 0;
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      ASSERT_EQ(found[i].positionW, wanted[i].positionW);
      EXPECT_EQ(found[i].irradiance, wanted[i].irradiance);
      dark += wanted[i].irradiance == vec3(0.f) ? 1 : 0;
    }
    EXPECT_GT(dark, wanted.size() / 20);  // in both shadows
    EXPECT_LT(dark, wanted.size() / 2);
  }
}

TEST(OddTriangles, FarOnesThrowShadowsWithinTheBound) {
  const auto dark = floorOf(
      sheltered({{vec3(-9e5f, 5, -9e5f), vec3(9e5f, 5, -9e5f), vec3(0, 5, 9e5f)}}), Unwrap::Charts);
  ASSERT_FALSE(dark.empty());
  const float lamp = 2.f / 9.f;  // no texel has more of it
  for (const LitTexel& texel : dark) EXPECT_LE(texel.irradiance.x, lamp * 1.001f);
}

TEST(Storable, InfiniteLightIsTheBrightestAndNoneIsDark) {
  EXPECT_EQ(storable(std::numeric_limits<float>::infinity()), kLargestHalf);
  EXPECT_EQ(storable(1e30f), kLargestHalf);
  EXPECT_EQ(storable(std::numeric_limits<float>::quiet_NaN()), 0.f);
  EXPECT_EQ(storable(0.25f), 0.25f);
  EXPECT_EQ(storable(0.f), 0.f);
}

}  // namespace
}  // namespace lucerna::bake
