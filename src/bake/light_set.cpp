#include "bake/light_set.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace lucerna::bake {

std::vector<LightGroup> groupLights(const scene::Scene& scene, float mostReach) {
  std::map<std::string, LightGroup> byName;
  byName[""];
  for (std::uint32_t i = 0; i < scene.lights.size(); ++i) {
    const scene::Light& light = scene.lights[i];
    if (i == scene.headlight || (light.group.empty() && !light.on)) continue;
    const mat4 worldFromLight =
        light.node == scene::kNone ? mat4(1.f) : scene.nodes[light.node].worldFromNode;
    scene::PlacedLight placed = scene::place(light, worldFromLight);
    placed.light = i;
    if (placed.kind != scene::LightKind::Directional)
      placed.reach = std::min(placed.reach, mostReach);
    if (placed.reach > 0.f && placed.intensity != vec3(0.f))
      byName[light.group].lights.push_back(placed);
  }
  std::vector<LightGroup> groups;
  for (auto& [name, group] : byName) {
    group.name = name;
    groups.push_back(std::move(group));
  }
  return groups;
}

scene::Bvh reachTree(std::span<const scene::PlacedLight> lights) {
  std::vector<Aabb> boxes;
  for (const scene::PlacedLight& light : lights) {
    // Distances count from the light's surface. Directional lights reach everywhere.
    const vec3 reach(light.kind == scene::LightKind::Directional
                         ? std::numeric_limits<float>::infinity()
                         : light.reach + light.radius);
    boxes.push_back({light.positionW - reach, light.positionW + reach});
  }
  scene::Bvh tree;
  tree.build(boxes);
  return tree;
}

std::vector<scene::PlacedLight> skyLights(vec3 radiance, int directions) {
  std::vector<scene::PlacedLight> lights;
  if (radiance == vec3(0.f)) return lights;
  // Points of a spiral (Swinbank and Purser, "Fibonacci grids", 2006); each stands for as much of
  // the sphere.
  // A cone of that share: 2 pi (1 - cos half) = 4 pi / n. Its irradiance on what it faces is the
  // radiance times pi sin^2 half = (4 pi / n) (1 - 1 / n).
  const double share = 1. / directions;
  const auto angle = static_cast<float>(2. * std::acos(1. - 2. * share));
  const vec3 intensity =
      radiance * static_cast<float>(4. * glm::pi<double>() * share * (1. - share));
  const double golden = (1. + std::sqrt(5.)) / 2.;
  for (int i = 0; i < directions; ++i) {
    const double y = 1. - (2. * i + 1.) * share;
    const double across = std::sqrt(1. - y * y), turn = 2. * glm::pi<double>() * i / golden;
    scene::PlacedLight light;
    light.kind = scene::LightKind::Directional;
    light.directionW = -vec3(across * std::cos(turn), y, across * std::sin(turn));
    light.intensity = intensity;
    light.angle = angle;
    light.reach = std::numeric_limits<float>::infinity();
    lights.push_back(light);
  }
  return lights;
}

bool isOfSky(const scene::PlacedLight& light) {
  return light.kind == scene::LightKind::Directional && light.light == scene::kNone;
}

}  // namespace lucerna::bake
