// Suns and skies near what reaches very far: shadows near their casters are as without it.
#include <gtest/gtest.h>

#include <cmath>

#include "bake/light_points.hpp"
#include "bake/light_scenes.hpp"
#include "bake/shadow_tracer.hpp"

namespace lucerna::bake {
namespace {

using namespace testing;
using scene::LightKind;

const vec3 kAlong = glm::normalize(vec3(0.3f, -1.f, 0.2f));  // of the sun
constexpr float kHeight = 0.05f;                             // m, of the sheet

// A floor with a thin sheet over its middle, in the sun; and what takes no light: the ground below,
// as far as `reach` m, and a post at its end, away from the sun, which is as high. The floor is the
// first object.
scene::Scene floorWithSheet(float reach, bool sun) {
  scene::Scene scene = trace::testing::emptyScene();
  addSurface(scene);
  addRectangle(scene, vec3(0), vec3(0, 0, 2), vec3(2, 0, 0));
  addRectangle(scene, vec3(0, kHeight, 0), vec3(0, 0, 0.5f), vec3(0.5f, 0, 0));
  if (sun) addLight(scene, LightKind::Directional, vec3(0, 10, 0), kAlong).intensity = 1.f;
  if (reach <= 0.f) return scene;
  addSurface(scene).model = scene::MaterialModel::Unlit;
  addRectangle(scene, vec3(0, -0.01f, 0), vec3(0, 0, reach), vec3(reach, 0, 0));
  addRectangle(scene, vec3(reach, 0.5f * reach, reach), vec3(1, 0, 0), vec3(0, 0.5f * reach, 0));
  return scene;
}

std::vector<LitTexel> floorOf(const scene::Scene& scene, Engine engine, vec3 sky) {
  BakeSettings settings;
  settings.density = 10.f;
  settings.engine = engine;
  settings.sky = sky;
  settings.sampling.skyDirections = 64;
  settings.sampling.finePositions = 0;  // what the middle sees
  const Result<Plan> plan = makePlan(scene, settings);
  EXPECT_TRUE(plan) << plan.error().message;
  return texelsOf(lightAll(*plan), 0);
}

class FarGround : public ::testing::TestWithParam<Engine> {};
INSTANTIATE_TEST_SUITE_P(Engines, FarGround, ::testing::Values(Engine::Embree, Engine::Octree));

constexpr float kReaches[] = {35e3f, 9e5f};

TEST_P(FarGround, TheSunKeepsItsContactShadows) {
  for (const float reach : kReaches) {
    std::size_t dark = 0;
    const auto texels = floorOf(floorWithSheet(reach, true), GetParam(), vec3(0.f));
    for (const LitTexel& texel : texels) {
      const vec3 at = texel.placesW[0] - kAlong * (kHeight / -kAlong.y);  // on the sheet's plane
      const float inside = 0.5f - std::max(std::abs(at.x), std::abs(at.z));
      if (std::abs(inside) < 1e-3f) continue;
      EXPECT_NEAR(texel.irradiance.x, inside > 0.f ? 0.f : -kAlong.y, 1e-5f)
          << at.x << ' ' << at.z << ' ' << reach;
      if (inside > 0.f) ++dark;
    }
    EXPECT_GT(dark, 80u);
    EXPECT_GT(texels.size(), 1500u);
  }
}

TEST_P(FarGround, TheSkyKeepsItsContactShadows) {
  const auto wanted = floorOf(floorWithSheet(0.f, false), GetParam(), vec3(1.f));
  for (const float reach : kReaches) {
    const auto found = floorOf(floorWithSheet(reach, false), GetParam(), vec3(1.f));
    ASSERT_EQ(found.size(), wanted.size());
    std::size_t dark = 0;
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      EXPECT_NEAR(found[i].irradiance.x, wanted[i].irradiance.x, 1e-3f) << reach;
      if (found[i].irradiance.x < 0.1f) ++dark;
    }
    EXPECT_GT(dark, 40u);
  }
}

TEST(WayOut, LeavesTheBox) {
  const Aabb box{vec3(-4, 0, -2), vec3(4, 3, 2)};
  const vec3 up(0, 1, 0), across = glm::normalize(vec3(1, 0, 1));
  EXPECT_NEAR(wayOut(box, vec3(1, 1, 1), up), 2.f, 0.1f);
  EXPECT_GT(wayOut(box, vec3(1, 1, 1), up), 2.f * (1.f + kClearOfLight));
  EXPECT_NEAR(wayOut(box, vec3(0, 1, 0), -across), 2.f * std::sqrt(2.f), 0.1f);
  // On its border and just beyond it: not nothing, so that the ray has a direction.
  for (const float y : {3.f, 3.001f}) {
    EXPECT_GT(wayOut(box, vec3(0, y, 0), up), 0.1f);
    EXPECT_LT(wayOut(box, vec3(0, y, 0), up), 0.3f);
  }
  EXPECT_GT(wayOut({vec3(0), vec3(0)}, vec3(0), up), 1e-3f);
}

// Of samples near the origin and of those far away.
TEST(ShadowRays, AreClearOfTheirSampleByLittle) {
  for (const float length : {1e-3f, 1.f, 1e3f, 1e6f})
    for (const float position : {0.f, 10.f, 1e4f, 9e5f}) {
      const vec3 to = length * glm::normalize(vec3(1, 2, 3));
      const float metres = length * clearOfSample(vec3(0, position, 1), to);
      EXPECT_GT(metres, 0.f);
      EXPECT_LT(metres, std::max(1e-3f, liftAt(vec3(0, position, 1))));
      EXPECT_LE(metres, length * kClearOfSample * 1.0001f);
    }
}

}  // namespace
}  // namespace lucerna::bake
