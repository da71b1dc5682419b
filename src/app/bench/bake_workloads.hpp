// What `bake` of lucerna bench bakes: the lights of the thesis' tables 6.2 to 6.4 (spec B), on any
// scene.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bake/plan.hpp"

namespace lucerna::app::bench {

enum class LoadLights {
  Lamps,        // the scene's, without emitting surfaces
  FewSurfaces,  // some two hundred cells of its emitting surfaces
  AllSurfaces,  // all of these
  Added,        // a sun with a size and lamps put anywhere
};

struct Load {
  std::string_view name;
  LoadLights lights;
  float reach = 0;  // m; 0: as far as the lights say
  // What the thesis took for them, one thread: rays, s; and a second, by its own count, millions.
  double thesisSeconds = 0, thesisRate = 0;
  bool quick = true;    // measured by --quick, too
  bool points = false;  // of lamps: their middles alone, as the thesis has it
};
// Of the tables.
std::span<const Load> thesisLoads();
const Load& addedLights();

// How a scene is measured.
struct BakeScene {
  std::string_view name;
  float density = 0;    // texels a unit
  bool tables = false;  // all of thesisLoads()
  bool rates = false;   // else: engines and rates, with lamps or, without any, added lights
};
// Of a name that is not known: all tables, and a density at which it fills a quarter of a map.
BakeScene bakeSceneOf(std::string_view name, const scene::Scene& scene);

// The scene goes with the plan.
struct LoadPlan {
  std::unique_ptr<scene::Scene> scene;
  bake::Plan plan;
  std::uint64_t lights = 0;  // or cells of emitting surfaces; 0: there is nothing to measure
};
Result<LoadPlan> planLoad(const scene::Scene& scene, const Load& load, float density,
                          std::uint64_t seed);

}  // namespace lucerna::app::bench
