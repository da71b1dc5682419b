#include "app/bench/bake_workloads.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "bake/emitters.hpp"
#include "scene/load.hpp"

namespace lucerna::app::bench {
namespace {

const Load& loadOf(LoadLights lights) {
  return *std::ranges::find(thesisLoads(), lights, &Load::lights);
}

std::size_t lampsOf(const bake::Plan& plan) {
  std::size_t lamps = 0;
  for (const bake::LightGroup& group : plan.groups) lamps += group.lights.size();
  return lamps;
}

TEST(BakeWorkloads, LampsAreAllOfTheSceneAndNothingElseShines) {
  const scene::Scene scene = *scene::loadScene("builtin:nightcity");
  const LoadPlan load = *planLoad(scene, loadOf(LoadLights::Lamps), 0.3f, 0);
  EXPECT_EQ(load.lights, 106u);
  EXPECT_EQ(lampsOf(load.plan), 106u);
  EXPECT_FALSE(load.plan.emittersShine());
}

TEST(BakeWorkloads, TheThesisLampsArePoints) {
  const scene::Scene scene = *scene::loadScene("builtin:nightcity");
  int points = 0;
  for (const Load& load : thesisLoads()) {
    if (load.lights != LoadLights::Lamps) continue;
    const LoadPlan planned = *planLoad(scene, load, 0.3f, 0);
    EXPECT_EQ(planned.lights, 106u);
    EXPECT_EQ(planned.plan.settings.sampling.lightSamples == 1, load.thesisSeconds > 0);
    points += load.points;
  }
  EXPECT_EQ(points, 1);
}

TEST(BakeWorkloads, TheThesisCityFillsEightMaps) {
  const scene::Scene scene = *scene::loadScene("builtin:nightcity");
  const float density = bakeSceneOf("nightcity", scene).density;
  const LoadPlan load = *planLoad(scene, loadOf(LoadLights::Lamps), density, 0);
  EXPECT_EQ(load.plan.packed.packing.maps, 8);
}

TEST(BakeWorkloads, FewSurfacesAreSomeOfAll) {
  const scene::Scene scene = *scene::loadScene("builtin:nightcity");
  const LoadPlan few = *planLoad(scene, loadOf(LoadLights::FewSurfaces), 0.3f, 0),
                 all = *planLoad(scene, loadOf(LoadLights::AllSurfaces), 0.3f, 0);
  EXPECT_GT(few.lights, 150u);
  EXPECT_LE(few.lights, 202u);
  EXPECT_GT(all.lights, 1000u);
  for (const LoadPlan* load : {&few, &all}) {
    const bake::Plan& plan = load->plan;
    EXPECT_TRUE(plan.emittersShine());
    EXPECT_EQ(lampsOf(plan), 0u);
    EXPECT_EQ(bake::findEmitters(plan.world, plan.charts.charts, 0, 36).cells, load->lights);
  }
}

TEST(BakeWorkloads, LightsAreAddedByTheSeed) {
  const scene::Scene scene = *scene::loadScene("builtin:cornell");
  const auto placeOf = [&](std::uint64_t seed) {
    const LoadPlan load = *planLoad(scene, addedLights(), 20.f, seed);
    EXPECT_EQ(load.lights, 17u);
    return load.plan.groups[0].lights.back().positionW;
  };
  EXPECT_EQ(placeOf(1), placeOf(1));
  EXPECT_NE(placeOf(1), placeOf(2));
}

TEST(BakeWorkloads, ASceneThatIsNotKnownFillsAQuarterOfAMap) {
  const scene::Scene scene = *scene::loadScene("builtin:cornell");
  const BakeScene choice = bakeSceneOf("mine", scene);
  EXPECT_TRUE(choice.tables);
  const LoadPlan load = *planLoad(scene, loadOf(LoadLights::Lamps), choice.density, 0);
  EXPECT_NEAR(static_cast<double>(load.plan.texels()) / (1024 * 1024), 1, 0.25);
}

}  // namespace
}  // namespace lucerna::app::bench
