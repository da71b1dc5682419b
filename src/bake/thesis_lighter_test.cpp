// The thesis' way of lighting against the other engine's, and how many rays it takes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bake/light_scenes.hpp"
#include "bake/unit_light.hpp"

namespace lucerna::bake {
namespace {

using namespace testing;
using scene::LightKind;

std::vector<LitTexel> litBy(Engine engine, Plan& plan) {
  plan.settings.engine = engine;
  return lightAll(plan);
}

struct Difference {
  double rms = 0, share = 0;  // of the largest value; of texels that differ by more than 1e-4 of it
};

Difference between(Plan& plan) {
  const std::vector<LitTexel> embree = litBy(Engine::Embree, plan),
                              octree = litBy(Engine::Octree, plan);
  EXPECT_EQ(embree.size(), octree.size());
  double largest = 0, squares = 0, differ = 0;
  for (const LitTexel& texel : embree)
    largest = std::max(largest, static_cast<double>(texel.irradiance.x));
  EXPECT_GT(largest, 0);
  for (std::size_t i = 0; i < embree.size(); ++i) {
    const double off = static_cast<double>(embree[i].irradiance.x - octree[i].irradiance.x);
    squares += off * off;
    differ += std::abs(off) > 1e-4 * largest ? 1 : 0;
  }
  const auto count = static_cast<double>(embree.size());
  return {.rms = std::sqrt(squares / count) / largest, .share = differ / count};
}

LightCounters countersOf(Engine engine, Plan& plan) {
  plan.settings.engine = engine;
  const LightScene scene(plan);
  UnitLighter lighter(plan, scene);
  for (const Unit& unit : plan.units) lighter.light(unit);
  return lighter.counters();
}

// A floor of 4 m, a wall at its end, and a board over it.
scene::Scene yard() {
  scene::Scene scene;
  addSurface(scene);
  addRectangle(scene, {0, 0, 0}, {2, 0, 0}, {0, 0, -2});
  addRectangle(scene, {0, 1, -2}, {2, 0, 0}, {0, 1, 0});
  addRectangle(scene, {0.3f, 0.7f, 0.2f}, {0.4f, 0.1f, 0}, {0, 0.1f, -0.3f});
  return scene;
}

scene::Light& addOne(scene::Scene& scene, LightKind kind) {
  return addLight(scene, kind, {0.2f, 2.1f, 0.4f}, vec3(0.1f, -1.f, -0.3f));
}

// As `standard`, without edges of shadows from more places and strong surfaces by more points,
// which engine octree leaves out.
Sampling onePlace() {
  Sampling sampling = kStandard;
  sampling.finePositions = 0;
  sampling.emitterShare = 1.f;
  return sampling;
}

TEST(ThesisLighter, PointsGiveTheSameByBothEngines) {
  for (const LightKind kind : {LightKind::Point, LightKind::Spot, LightKind::Directional})
    for (const float exponent : {0.f, 0.5f}) {
      scene::Scene scene = yard();
      scene::Light& light = addOne(scene, kind);
      light.exponent = exponent;
      light.attenuation = {0.5f, 0.2f, 0.3f};
      light.range = 3.5f;  // the floor's far corners are beyond it
      Plan plan = planOf(scene, {.density = 20.f, .sampling = onePlace()});
      // Rays along edges may be told apart.
      EXPECT_LT(between(plan).share, 5e-4) << static_cast<int>(kind);
    }
}

TEST(ThesisLighter, LightsWithASizeComeOutAlike) {
  for (const LightKind kind : {LightKind::Point, LightKind::Spot, LightKind::Directional}) {
    scene::Scene scene = yard();
    scene::Light& light = addOne(scene, kind);
    light.radius = 0.2f;
    light.angle = 0.1f;
    Plan plan = planOf(scene, {.density = 20.f});
    const Difference difference = between(plan);
    EXPECT_LT(difference.rms, 0.02) << static_cast<int>(kind);
    EXPECT_GT(difference.share, 0);
  }
}

// Edges of shadows are lit again by both; what is left is the noise of their points.
TEST(ThesisLighter, FinalComesOutAlike) {
  for (const LightKind kind : {LightKind::Point, LightKind::Spot, LightKind::Directional})
    for (const float size : {0.f, 0.2f}) {
      scene::Scene scene = yard();
      scene::Light& light = addOne(scene, kind);
      light.radius = size;
      light.angle = 0.5f * size;
      Plan plan = planOf(scene, {.density = 20.f, .sampling = kFinal});
      EXPECT_LT(between(plan).rms, 0.00053) << static_cast<int>(kind) << ", size " << size;
    }
}

// A lamp of 8 x 8 cells of 5 cm, 2 m above.
scene::Scene lampOverYard() {
  scene::Scene scene = yard();
  addSurface(scene, vec3(20.f));
  addRectangle(scene, {0.2f, 2, 0.1f}, {0.2f, 0, 0}, {0, 0, 0.2f});
  return scene;
}

TEST(ThesisLighter, SurfacesThatShineComeOutAlikeFromAfar) {
  scene::Scene scene = lampOverYard();
  Plan plan = planOf(scene, {.density = 20.f});
  EXPECT_LT(between(plan).rms, 0.02);
}

TEST(ThesisLighter, EveryTexelAsksEveryCellThatItFaces) {
  scene::Scene scene;
  addSurface(scene);
  const std::uint32_t floor = addRectangle(scene, {0, 0, 0}, {2, 0, 0}, {0, 0, -2});
  addSurface(scene, vec3(20.f));
  addRectangle(scene, {0.2f, 2, 0.1f}, {0.2f, 0, 0}, {0, 0, 0.2f});
  Plan plan = planOf(scene, {.density = 20.f, .sampling = onePlace()});
  const std::size_t texels = texelsOf(litBy(Engine::Octree, plan), floor).size();
  const LightScene lightScene(plan);
  ASSERT_EQ(lightScene.cells.size(), lightScene.emitters.cells);
  EXPECT_GE(lightScene.cells.size(), 64u);
  const LightCounters octree = countersOf(Engine::Octree, plan);
  EXPECT_EQ(octree.rays, texels * lightScene.cells.size());
  EXPECT_EQ(octree.pairs, octree.rays);
  EXPECT_LT(20 * countersOf(Engine::Embree, plan).rays, octree.rays);
}

TEST(ThesisLighter, WhatALampCannotLightCostsNoRay) {
  scene::Scene scene;
  addSurface(scene);
  addRectangle(scene, {0, 0, 0}, {2, 0, 0}, {0, 0, -2});
  addRectangle(scene, {0, 3, 0}, {2, 0, 0}, {0, 0, -2});  // its back to the lamp
  scene::Light& light = addOne(scene, LightKind::Spot);
  light.outerCone = 0.4f;
  Plan plan = planOf(scene, {.density = 20.f});
  std::uint64_t lit = 0;
  for (const LitTexel& texel : litBy(Engine::Octree, plan)) lit += texel.irradiance.x > 0.f;
  EXPECT_GT(lit, 100u);
  EXPECT_EQ(countersOf(Engine::Octree, plan).rays, lit);
}

}  // namespace
}  // namespace lucerna::bake
