#include "bake/light_set.hpp"

#include <algorithm>
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

}  // namespace lucerna::bake
