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
  double edges = 0.;  // share of the squared error that lies in texels off by more than 2 %
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
  double squares = 0., large = 0.;
  for (double& o : off) {
    o /= mean;
    result.bias += o / static_cast<double>(off.size());
    squares += o * o;
    if (std::abs(o) > 0.02) large += o * o;
    o = std::abs(o);
  }
  result.rmse = std::sqrt(squares / static_cast<double>(off.size()));
  result.edges = large / squares;
  std::ranges::sort(off);
  result.p99 = off[off.size() * 99 / 100];
  result.p50 = off[off.size() / 2];
  std::printf("%-40s %s rmse %.4f p50 %.5f p99 %.4f bias %+.5f edges %.2f\n", c.scene,
              sampling.positions == 1 ? "standard" : "final", result.rmse, result.p50, result.p99,
              result.bias, result.edges);
  return result;
}

TEST(BruteForce, Scenes) {
  for (const Case& c :
       {Case{"builtin:penumbra", 20.f, 1, 2000, 1024}, Case{"builtin:cornell", 30.f, 1, 1000, 1024},
        Case{"builtin:atrium", 8.f, 20, 1000, 1024, false},
        Case{"builtin:atrium?kind=point", 8.f, 20, 1000, 1024, false},
        Case{"builtin:nightcity", 1.75f, 100, 1000, 1024, false}})
    for (const Sampling& sampling : {kStandard, kFinal}) compare(c, sampling);
}

}  // namespace
}  // namespace lucerna::bake
