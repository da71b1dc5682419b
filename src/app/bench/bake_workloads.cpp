#include "app/bench/bake_workloads.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "bake/emitters.hpp"
#include "bake/triangle.hpp"
#include "core/random.hpp"

namespace lucerna::app::bench {
namespace {

constexpr std::uint64_t kFew = 202;  // as the thesis

constexpr double kHour = 3600;
// Reaches follow from attenuations of 0.2, 0.1 and 0.05 / m^2: where a light gives 1/256.
constexpr std::array<Load, 8> kLoads{{
    {"lamps", LoadLights::Lamps},
    {"lamps as points", LoadLights::Lamps, 0, 28.176 * 60, 0, true, true},
    {"few surfaces, 36 m", LoadLights::FewSurfaces, 36, 10.276, 657.89},
    {"few surfaces, 51 m", LoadLights::FewSurfaces, 51, 19.483, 348.43, false},
    {"few surfaces, 72 m", LoadLights::FewSurfaces, 72, 36.875, 183.82, false},
    {"all surfaces, 36 m", LoadLights::AllSurfaces, 36, 1.219 * kHour, 1149.43},
    {"all surfaces, 51 m", LoadLights::AllSurfaces, 51, 2.398 * kHour, 584.80, false},
    {"all surfaces, 72 m", LoadLights::AllSurfaces, 72, 4.746 * kHour, 294.99, false},
}};
constexpr Load kAdded{"added lights", LoadLights::Added};

double areaOf(const bake::World& world) {
  double area = 0;
  for (std::size_t i = 0; i < world.indices.size(); i += 3) {
    const vec3 a = world.positions[world.indices[i]], b = world.positions[world.indices[i + 1]],
               c = world.positions[world.indices[i + 2]];
    const auto part = static_cast<double>(0.5f * glm::length(glm::cross(b - a, c - a)));
    if (std::isfinite(part)) area += part;
  }
  return area;
}

std::uint64_t cellsOf(const bake::Plan& plan) {
  return bake::findEmitters(plan.world, plan.charts.charts, 0, plan.settings.reach).cells;
}

// Of each of the world's objects: cells of its emitting surfaces.
std::vector<std::uint64_t> cellsOfObjects(const bake::Plan& plan) {
  std::vector<std::vector<bake::Chart>> charts(plan.world.objects.size());
  for (const bake::Chart& chart : plan.charts.charts) charts[chart.object].push_back(chart);
  std::vector<std::uint64_t> cells;
  for (const auto& own : charts)
    cells.push_back(bake::findEmitters(plan.world, own, 0, plan.settings.reach).cells);
  return cells;
}

// Darkens objects until no more cells shine than wanted: the first ones stay that fit, and one at
// least. Returns how many cells do.
std::uint64_t leaveFew(LoadPlan& load) {
  scene::Scene& scene = *load.scene;
  const std::vector<std::uint64_t> cells = cellsOfObjects(load.plan);
  std::map<std::uint32_t, std::uint32_t> dark;  // copies of materials
  std::uint64_t left = 0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (cells[i] == 0) continue;
    if (left == 0 || left + cells[i] <= kFew) {
      left += cells[i];
      continue;
    }
    std::uint32_t& material = scene.objects[load.plan.world.objects[i].object].material;
    const auto [copy, isNew] =
        dark.emplace(material, static_cast<std::uint32_t>(scene.materials.size()));
    if (isNew) {
      scene.materials.push_back(scene.materials[material]);
      scene.materials.back().emissive = vec3(0.f);
    }
    material = copy->second;
  }
  return left;
}

// A sun and sixteen lamps that reach a quarter of the scene's diagonal.
std::vector<scene::PlacedLight> lightsAnywhere(const bake::World& world, std::uint64_t seed) {
  Aabb box;
  for (const vec3 p : world.positions)
    if (bake::isFinite(p)) box.grow(p);
  scene::PlacedLight sun;
  sun.kind = scene::LightKind::Directional;
  sun.directionW = glm::normalize(vec3(0.4f, -1.f, 0.3f));
  sun.intensity = vec3(3.f);
  sun.angle = 0.0093f;
  sun.reach = std::numeric_limits<float>::infinity();
  std::vector<scene::PlacedLight> lights{sun};
  Random random(seed, 90);
  constexpr int kLamps = 16;
  for (int i = 0; i < kLamps; ++i) {
    scene::PlacedLight lamp;
    for (int axis = 0; axis < 3; ++axis)
      lamp.positionW[axis] = glm::mix(box.min[axis], box.max[axis], random.uniform(0.1f, 0.9f));
    lamp.intensity = vec3(1.f);
    lamp.reach = 0.25f * box.diagonal();
    lights.push_back(lamp);
  }
  return lights;
}

std::uint64_t lampsOf(const bake::Plan& plan) {
  std::uint64_t lamps = 0;
  for (const bake::LightGroup& group : plan.groups) lamps += group.lights.size();
  return lamps;
}

}  // namespace

std::span<const Load> thesisLoads() {
  return kLoads;
}

const Load& addedLights() {
  return kAdded;
}

BakeScene bakeSceneOf(std::string_view name, const scene::Scene& scene) {
  static constexpr std::array<BakeScene, 6> kKnown{{{"nightcity", 2.05f, true, true},
                                                    {"nightcity, turned", 2.05f, false, true},
                                                    {"atrium", 60.f, false, false},
                                                    {"sponza", 0.4f, false, true},
                                                    {"street-1", 2.5f, false, true},
                                                    {"institute", 2.f, false, false}}};
  const auto known = std::ranges::find(kKnown, name, &BakeScene::name);
  if (known != kKnown.end()) return *known;
  constexpr double kTexels = 1024 * 1024;
  const double area = std::max(areaOf(bake::makeWorld(scene)), 1e-9);
  return {name, static_cast<float>(std::sqrt(kTexels / area)), true, true};
}

Result<LoadPlan> planLoad(const scene::Scene& scene, const Load& load, float density,
                          std::uint64_t seed) {
  LoadPlan result{.scene = std::make_unique<scene::Scene>(scene), .plan = {}};
  const bool surfaces =
      load.lights == LoadLights::FewSurfaces || load.lights == LoadLights::AllSurfaces;
  result.scene->bake.areaLights = surfaces;
  bake::BakeSettings settings;
  settings.density = density;
  settings.sampling.finePositions = 0;  // the same work for both engines
  settings.sampling.emitterShare = 1.f;
  settings.faintest = 0;
  if (load.reach > 0) settings.reach = load.reach;
  settings.sampling.lightSamples = load.points ? 1 : 16;
  LUCERNA_TRY(plan, bake::makePlan(*result.scene, settings));
  result.plan = std::move(plan);
  if (surfaces || load.lights == LoadLights::Added)
    for (bake::LightGroup& group : result.plan.groups) group.lights.clear();
  if (load.lights == LoadLights::Added)
    result.plan.groups[0].lights = lightsAnywhere(result.plan.world, seed);
  result.lights = load.lights == LoadLights::FewSurfaces   ? leaveFew(result)
                  : load.lights == LoadLights::AllSurfaces ? cellsOf(result.plan)
                                                           : lampsOf(result.plan);
  return result;
}

}  // namespace lucerna::app::bench
