// Baked light against brute force, on whole scenes.
#include "bake/brute_force.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bake/light_scenes.hpp"
#include "core/parallel.hpp"
#include "core/random.hpp"
#include "scene/load.hpp"

namespace lucerna::bake {
namespace {

using namespace testing;

struct Comparison {
  double rmse = 0., p99 = 0., p50 = 0., bias = 0.;  // shares of the mean
};

struct Case {
  const char* scene;
  float density;
  std::size_t blocks;  // every n-th of them
  std::uint32_t texels, samples;
  bool emitters = true;
  Unwrap unwrap = Unwrap::Charts;
};

Comparison compare(const Case& c, const Sampling& sampling) {
  auto scene = scene::loadScene(c.scene);
  EXPECT_TRUE(scene);
  scene::animate(*scene, 0.f);
  scene->bake.areaLights = c.emitters;
  const Plan plan = planOf(*scene, {.density = c.density, .sampling = sampling});
  std::vector<LitTexel> lit = lightSome(plan, c.blocks);
  std::erase_if(lit, [](const LitTexel& t) { return t.border; });
  Random random(7);
  std::vector<LitTexel> chosen;
  for (std::uint32_t i = 0; i < c.texels; ++i)
    chosen.push_back(
        lit[static_cast<std::size_t>(random.uniform(0, 1) * static_cast<float>(lit.size() - 1))]);
  const BruteForce truth(plan);
  std::vector<double> wanted(chosen.size()), off(chosen.size());
  parallelFor(chosen.size(), 8, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const vec3 e = truth.irradiance(chosen[i].chart, chosen[i].texel, c.samples);
      wanted[i] = (e.x + e.y + e.z) / 3.;
      const vec3 found = chosen[i].irradiance;
      off[i] = (found.x + found.y + found.z) / 3. - wanted[i];
    }
  });
  double mean = 0.;
  for (const double w : wanted) mean += w / static_cast<double>(wanted.size());
  Comparison result;
  double squares = 0.;
  for (double& o : off) {
    o /= mean;
    result.bias += o / static_cast<double>(off.size());
    squares += o * o;
    o = std::abs(o);
  }
  result.rmse = std::sqrt(squares / static_cast<double>(off.size()));
  std::ranges::sort(off);
  result.p99 = off[off.size() * 99 / 100];
  result.p50 = off[off.size() / 2];
  return result;
}

// The preset `final`. Its goal is 0.5 % of the mean as root mean square and 2 % for 99 of 100
// texels; of 1000 texels there were, in this order, 0.25, 0.8, 0.4, 1.3 and 0.1 %, and 1.9, 3.7,
// 1.9, 4.7 and 0.1 %. Bounds are for 500 texels, which vary; the atrium's are the goal, for 3000, as
// of 6000 there were 0.33 and 1.15 %.
void expectFinal(const Case& c, double rmse, double p99) {
  const Comparison found = compare(c, kFinal);
  EXPECT_LT(found.rmse, rmse) << c.scene;
  EXPECT_LT(found.p99, p99) << c.scene;
  EXPECT_LT(std::abs(found.bias), 0.005) << c.scene;
}

TEST(BruteForce, FinalAgreesOnPenumbra) {
  expectFinal({"builtin:penumbra", 20.f, 1, 500, 1024}, 0.005, 0.025);
}
TEST(BruteForce, FinalAgreesOnCornell) {
  expectFinal({"builtin:cornell", 30.f, 1, 500, 1024}, 0.012, 0.05);
}
TEST(BruteForce, FinalAgreesOnAtrium) {
  expectFinal({"builtin:atrium", 8.f, 10, 3000, 1024, false}, 0.005, 0.02);
}
// Ironwork close to the lamps is seen from few of their points.
TEST(BruteForce, FinalAgreesOnAtriumWithSpheres) {
  expectFinal({"builtin:atrium?kind=point", 8.f, 40, 500, 1024, false}, 0.03, 0.1);
}
TEST(BruteForce, FinalAgreesOnNightCity) {
  expectFinal({"builtin:nightcity", 1.75f, 200, 500, 1024, false}, 0.006, 0.02);
}

// One place a texel: at the edges of shadows it is off by what they cut from the texel; elsewhere
// it is not.
TEST(BruteForce, StandardAgreesAwayFromEdges) {
  for (const Case& c :
       {Case{"builtin:penumbra", 20.f, 1, 500, 1024}, Case{"builtin:cornell", 30.f, 1, 500, 1024},
        Case{"builtin:atrium", 8.f, 40, 500, 1024, false}}) {
    const Comparison found = compare(c, kStandard);
    EXPECT_LT(found.p50, 0.003) << c.scene;
    EXPECT_LT(found.rmse, 0.3) << c.scene;
    EXPECT_LT(std::abs(found.bias), 0.02) << c.scene;
  }
}

}  // namespace
}  // namespace lucerna::bake
