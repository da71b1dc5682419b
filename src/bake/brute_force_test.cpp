// Baked light against brute force, on whole scenes.
#include "bake/brute_force.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <chrono>

#include "bake/light_scenes.hpp"
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
  bool surfaces = false;
  Effort effort{};
};

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

void run(const Case& c, const char* name) {
  auto scene = scene::loadScene(c.scene);
  ASSERT_TRUE(scene);
  scene::animate(*scene, 0.f);
  scene->bake.areaLights = c.surfaces;
  if (c.surfaces) scene->lights.clear();
  const bool noise = std::getenv("NOISE") != nullptr;
  std::vector<std::pair<std::uint32_t, ivec2>> chosen;
  std::vector<double> wanted;
  const std::string cache = fmt::format("/tmp/truth_cache/{}{}", name, noise ? "_noise" : "");
  {
    const Plan plan = planOf(*scene, {.density = c.density, .sampling = kFinal});
    if (FILE* f = std::fopen(cache.c_str(), "r")) {
      unsigned chart; int x, y; double w;
      while (std::fscanf(f, "%u %d %d %lf", &chart, &x, &y, &w) == 4) { chosen.push_back({chart, {x, y}}); wanted.push_back(w); }
      std::fclose(f);
    } else {
      Sampling cheap = kStandard; cheap.positions = 4;
      const Plan plan2 = planOf(*scene, {.density = c.density, .sampling = cheap});
      std::vector<LitTexel> lit = lightSome(plan2, c.blocks);
      std::erase_if(lit, [](const LitTexel& t) { return t.border; });
      const std::size_t all = lit.size();
      if (c.surfaces) std::erase_if(lit, [](const LitTexel& t) { return t.irradiance == vec3(0.f); });
      std::printf("%s: %zu inner texels, %zu left\n", name, all, lit.size());
      Random random(7);
      for (std::uint32_t i = 0; i < c.texels; ++i) {
        const auto& t = lit[random.below(static_cast<std::uint32_t>(lit.size()))];
        chosen.push_back({t.chart, t.texel});
      }
      const BruteForce truth(plan);
      wanted.resize(chosen.size());
      const double t0 = now();
      Effort effort = c.effort; effort.seed = noise;
      parallelFor(chosen.size(), 4, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
          const vec3 e = truth.irradiance(chosen[i].first, chosen[i].second, effort);
          wanted[i] = (e.x + e.y + e.z) / 3.;
        }
      });
      std::printf("%s: truth %.1f s\n", name, now() - t0);
      FILE* g = std::fopen(cache.c_str(), "w");
      for (std::size_t i = 0; i < chosen.size(); ++i) std::fprintf(g, "%u %d %d %.9g\n", chosen[i].first, chosen[i].second.x, chosen[i].second.y, wanted[i]);
      std::fclose(g);
    }
  }
  if (noise) return;
  std::map<std::tuple<std::uint32_t, int, int>, std::size_t> index;
  for (std::size_t i = 0; i < chosen.size(); ++i) index[{chosen[i].first, chosen[i].second.x, chosen[i].second.y}] = i;
  double mean = 0.;
  for (const double w : wanted) mean += w / static_cast<double>(wanted.size());
  Sampling fin = kFinal;
  if (const char* e = std::getenv("S")) std::sscanf(e, "%d %d %d %f", &fin.positions, &fin.finePositions, &fin.lightSamples, &fin.emitterSize);
  for (const auto& [what, sampling] : {std::pair{"final", fin}, std::pair{"standard", kStandard}}) {
    if (std::getenv("ONLY") && std::string(what) != std::getenv("ONLY")) continue;
    const Plan plan = planOf(*scene, {.density = c.density, .sampling = sampling});
    const double t0 = now();
    std::vector<LitTexel> lit = lightSome(plan, c.blocks);
    const double t1 = now();
    std::vector<double> found(wanted.size(), -1.);
    std::vector<vec3> pos(wanted.size());
    for (const auto& t : lit) {
      auto it = index.find({t.chart, t.texel.x, t.texel.y});
      if (it == index.end()) continue;
      found[it->second] = (t.irradiance.x + t.irradiance.y + t.irradiance.z) / 3.;
      pos[it->second] = t.positionW;
    }
    for (std::size_t i = 0; i < chosen.size(); ++i) if (found[i] < 0.) { const auto j = index[{chosen[i].first, chosen[i].second.x, chosen[i].second.y}]; found[i] = found[j]; pos[i] = pos[j]; }
    std::vector<double> off;
    double squares = 0., bias = 0.;
    FILE* g = std::getenv("DUMP") ? std::fopen(fmt::format("/tmp/truth_dump/{}_{}", name, what).c_str(), "w") : nullptr;
    std::size_t missing = 0;
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      if (found[i] < 0.) { ++missing; continue; }
      const double o = (found[i] - wanted[i]) / mean;
      squares += o * o; bias += o;
      off.push_back(std::abs(o));
      if (g) std::fprintf(g, "%u %d %d %g %g %g %g %g\n", chosen[i].first, chosen[i].second.x, chosen[i].second.y, wanted[i] / mean, o, pos[i].x, pos[i].y, pos[i].z);
    }
    if (g) std::fclose(g);
    std::ranges::sort(off);
    const double n = static_cast<double>(off.size()); if (off.empty()) continue;
    std::printf("%-18s %-9s rmse %.3f %% p99 %.3f %% p50 %.4f %% max %.2f %% bias %.3f %%  (light %.2f s, %zu texels lit, missing %zu)\n", name, what,
                100 * std::sqrt(squares / n), 100 * off[off.size() * 99 / 100], 100 * off[off.size() / 2], 100 * off.back(), 100 * bias / n, t1 - t0, lit.size(), missing);
  }
}

TEST(Truth, Penumbra) { run({"builtin:penumbra", 20.f, 1, 1000}, "penumbra"); }
TEST(Truth, Cornell) { run({"builtin:cornell", 30.f, 1, 1000}, "cornell"); }
TEST(Truth, AtriumSpots) { run({"builtin:atrium", 8.f, 10, 2000}, "atrium_spots"); }
TEST(Truth, AtriumSpheres) { run({"builtin:atrium?kind=point", 8.f, 10, 2000}, "atrium_spheres"); }
TEST(Truth, NightCity) { run({"builtin:nightcity", 1.75f, 200, 1000}, "nightcity"); }
TEST(Truth, CornellSurface) { run({"builtin:cornell", 30.f, 1, 1000, true}, "cornell_surface"); }
TEST(Truth, NightCitySurface) { run({"builtin:nightcity", 1.75f, 200, 500, true, {.places = 64}}, "nightcity_surface"); }
TEST(Truth, AtriumSurface) { run({"builtin:atrium", 8.f, 40, 500, true}, "atrium_surface"); }

}  // namespace
}  // namespace lucerna::bake
