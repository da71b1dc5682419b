#include "bake/hints.hpp"

namespace lucerna::bake {
namespace {

// BakeSettings::groups of the lights whose maps or patches the scene wants.
Result<std::vector<std::string>> hintedGroups(const scene::Scene& scene) {
  std::vector<std::string> groups;
  if (scene.bake.maps && scene.bake.patches) return groups;  // all
  if (scene.bake.maps) groups.emplace_back(kAlwaysOn);
  if (scene.bake.patches)
    for (const LightGroup& group : groupLights(scene, std::numeric_limits<float>::infinity()))
      if (!group.name.empty()) groups.push_back(group.name);
  if (groups.empty())
    return error(ErrorKind::Usage,
                 "'{}': its bake hints leave nothing to bake: no maps{}; change them, or give "
                 "--lights",
                 scene.name, scene.bake.patches ? ", and no light has a group" : " and no patches");
  return groups;
}

}  // namespace

Result<BakeSettings> withHints(BakeSettings settings, const Asked& asked,
                               const scene::Scene& scene) {
  if (asked.side)
    settings.pack.side = *asked.side;
  else if (scene.bake.mapSize)
    settings.pack.side = *scene.bake.mapSize;
  settings.patchTolerance = asked.patchTolerance ? asked.patchTolerance : scene.bake.patchTolerance;
  if (asked.groups) {
    settings.groups = *asked.groups;
  } else {
    LUCERNA_TRY(groups, hintedGroups(scene));
    settings.groups = std::move(groups);
  }
  return settings;
}

}  // namespace lucerna::bake
