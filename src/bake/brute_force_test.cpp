// Baked light against brute force, on whole scenes.
#include "bake/brute_force.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "bake/light_scenes.hpp"
#include "core/check.hpp"
#include "core/parallel.hpp"
#include "core/random.hpp"
#include "scene/load.hpp"

namespace lucerna::bake {
namespace {

using namespace testing;

struct Case {
  const char* scene;
  float density;
  std::size_t blocks;  // every n-th of them
  std::uint32_t texels;
  bool surfaces = false;  // what shines: the scene's lights, or its emitting surfaces
  Effort effort = {.places = 1024, .points = 8};
};

scene::Scene sceneOf(const Case& c) {
  auto scene = scene::loadScene(c.scene);
  CHECK(scene, "no scene {}", c.scene);
  scene::animate(*scene, 0.f);
  scene->bake.areaLights = c.surfaces;
  if (c.surfaces) scene->lights.clear();
  return std::move(*scene);
}

double brightness(vec3 irradiance) {
  return (irradiance.x + irradiance.y + irradiance.z) / 3.;
}

using Place = std::tuple<std::uint32_t, int, int>;  // chart and texel
std::map<Place, double> baked(const scene::Scene& scene, const Case& c, const Sampling& sampling,
                              bool inner) {
  const Plan plan = planOf(scene, {.density = c.density, .sampling = sampling});
  std::map<Place, double> light;
  for (const LitTexel& t : lightSome(plan, c.blocks))
    if (!inner || !t.border) light[{t.chart, t.texel.x, t.texel.y}] = brightness(t.irradiance);
  return light;
}

// Texels all of whose places are on the chart, and none of them hidden, as finely as `final` looks:
// what something divides goes with its middle (bake/hidden.hpp), which is not for here. Of emitting
// surfaces, those that they may light.
std::vector<Place> choose(const scene::Scene& scene, const Case& c) {
  scene::Scene dark = scene;
  dark.lights.clear();
  dark.bake.areaLights = false;
  Sampling fine = kPreview;
  fine.positions = kFinal.finePositions;
  std::map<Place, double> light;
  if (c.surfaces) light = baked(scene, c, kPreview, false);
  std::vector<Place> all, chosen;
  for (const auto& [place, none] : baked(dark, c, fine, true))
    if (!c.surfaces || light[place] > 0.) all.push_back(place);
  Random random(7);
  for (std::uint32_t i = 0; i < c.texels && !all.empty(); ++i)
    chosen.push_back(all[random.below(static_cast<std::uint32_t>(all.size()))]);
  return chosen;
}

std::vector<double> truthOf(const scene::Scene& scene, const Case& c,
                            const std::vector<Place>& places, std::uint32_t seed) {
  const Plan plan = planOf(scene, {.density = c.density, .sampling = kFinal});
  const BruteForce truth(plan);
  Effort effort = c.effort;
  effort.seed = seed;
  std::vector<double> wanted(places.size());
  parallelFor(places.size(), 4, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto& [chart, x, y] = places[i];
      wanted[i] = brightness(truth.irradiance(chart, {x, y}, effort));
    }
  });
  return wanted;
}

struct Comparison {
  double rmse = 0., p99 = 0., p50 = 0., bias = 0.;  // shares of the mean
};

Comparison compare(const std::vector<double>& found, const std::vector<double>& wanted) {
  Comparison result;
  const auto count = static_cast<double>(wanted.size());
  double mean = 0., squares = 0.;
  for (const double w : wanted) mean += w / count;
  std::vector<double> off;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const double o = (found[i] - wanted[i]) / mean;
    result.bias += o / count;
    squares += o * o / count;
    off.push_back(std::abs(o));
  }
  result.rmse = std::sqrt(squares);
  std::ranges::sort(off);
  result.p99 = off[off.size() * 99 / 100];
  result.p50 = off[off.size() / 2];
  return result;
}

Comparison compare(const scene::Scene& scene, const Case& c, const Sampling& sampling,
                   const std::vector<Place>& places, const std::vector<double>& wanted) {
  std::map<Place, double> light = baked(scene, c, sampling, false);
  std::vector<double> found;
  for (const Place& place : places) found.push_back(light[place]);
  return compare(found, wanted);
}

Comparison compare(const Case& c, const Sampling& sampling) {
  const scene::Scene scene = sceneOf(c);
  const std::vector<Place> places = choose(scene, c);
  EXPECT_EQ(places.size(), c.texels);
  return compare(scene, c, sampling, places, truthOf(scene, c, places, 0));
}

// The preset `final`: its goal.
void expectFinal(const Case& c) {
  const Comparison found = compare(c, kFinal);
  EXPECT_LT(found.rmse, 0.005) << c.scene;
  EXPECT_LT(found.p99, 0.02) << c.scene;
  EXPECT_LT(std::abs(found.bias), 0.002) << c.scene;
}

TEST(BruteForce, FinalAgreesOnPenumbra) {
  expectFinal({"builtin:penumbra", 20.f, 1, 400});
}
TEST(BruteForce, FinalAgreesOnCornell) {
  expectFinal({"builtin:cornell", 30.f, 1, 1000});
}
TEST(BruteForce, FinalAgreesOnCornellsLampAsASurface) {
  expectFinal({"builtin:cornell", 30.f, 1, 1000, true});
}
TEST(BruteForce, FinalAgreesOnAtrium) {
  expectFinal({"builtin:atrium", 8.f, 40, 400});
}
TEST(BruteForce, FinalAgreesOnAtriumWithSpheres) {
  expectFinal({"builtin:atrium?kind=point", 8.f, 40, 200});
}
TEST(BruteForce, FinalAgreesOnNightCity) {
  expectFinal({"builtin:nightcity", 1.75f, 200, 500});
}

// The preset `standard`: nine places at the edges of lamps' shadows, one elsewhere and of surfaces.
void expectStandard(const Case& c, double rmse) {
  const Comparison found = compare(c, kStandard);
  EXPECT_LT(found.p50, 0.003) << c.scene;
  EXPECT_LT(found.rmse, rmse) << c.scene;
  EXPECT_LT(std::abs(found.bias), 0.005) << c.scene;
}

TEST(BruteForce, StandardAgreesMoreOrLess) {
  const Effort less = {.places = 256, .points = 8};
  expectStandard({"builtin:penumbra", 20.f, 1, 400, false, less}, 0.006);
  expectStandard({"builtin:cornell", 30.f, 1, 500, false, less}, 0.018);
  expectStandard({"builtin:cornell", 30.f, 1, 500, true, less}, 0.024);
  expectStandard({"builtin:atrium", 8.f, 10, 1000, false, less}, 0.016);
}

void print(const Case& c, const char* what, const Comparison& found) {
  fmt::print("{}{} {}: RMSE {:.3f} %, 99th percentile {:.2f} %, median {:.4f} %, bias {:.3f} %\n",
             c.scene, c.surfaces ? ", surfaces" : "", what, 100. * found.rmse, 100. * found.p99,
             100. * found.p50, 100. * found.bias);
}

// The figures of docs/dev/baking.md: minutes. Against the mean of two truths of other places and
// points, of which half the difference is the noise.
TEST(BruteForce, DISABLED_Figures) {
  const Effort most = {.places = 1024, .points = 16};
  for (const Case& c : {Case{"builtin:penumbra", 20.f, 1, 1000, false, most},
                        Case{"builtin:cornell", 30.f, 1, 1000, false, most},
                        Case{"builtin:cornell", 30.f, 1, 1000, true, most},
                        Case{"builtin:atrium", 8.f, 10, 1000, false, most},
                        Case{"builtin:atrium?kind=point", 8.f, 10, 1000, false, most},
                        Case{"builtin:nightcity", 1.75f, 200, 1000, false, most},
                        Case{"builtin:nightcity", 1.75f, 2000, 300, true, {.places = 1024}}}) {
    const scene::Scene scene = sceneOf(c);
    const std::vector<Place> places = choose(scene, c);
    std::vector<double> wanted = truthOf(scene, c, places, 0);
    const std::vector<double> other = truthOf(scene, c, places, 1);
    for (std::size_t i = 0; i < wanted.size(); ++i) wanted[i] = 0.5 * (wanted[i] + other[i]);
    print(c, "noise", compare(other, wanted));
    print(c, "final", compare(scene, c, kFinal, places, wanted));
    print(c, "standard", compare(scene, c, kStandard, places, wanted));
    std::fflush(stdout);
  }
}

}  // namespace
}  // namespace lucerna::bake
