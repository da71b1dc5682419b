#include "app/baked_light.hpp"

#include <algorithm>
#include <set>

#include "bake/light_set.hpp"
#include "bake/own_files.hpp"
#include "core/log.hpp"
#include "core/text.hpp"
#include "lightmap/place.hpp"
#include "lightmap/scene_hash.hpp"
#include "lightmap/switching.hpp"

namespace lucerna::app {
namespace {

std::vector<std::string> groupsOf(const lightmap::Manifest& manifest) {
  std::set<std::string> groups;
  for (const lightmap::PatchEntry& patch : manifest.patches) groups.insert(patch.group);
  return {groups.begin(), groups.end()};
}

bool isAmong(const std::vector<std::string>& names, const std::string& name) {
  return std::ranges::find(names, name) != names.end();
}

Status checkGroups(const lightmap::Manifest& manifest, const std::vector<std::string>& wanted) {
  const std::vector<std::string> groups = groupsOf(manifest);
  const std::string there = groups.empty() ? "the lightmap has none that could be switched"
                                           : "wanted one of " + join(groups);
  for (const std::string& group : wanted) {
    if (isAmong(groups, group)) continue;
    if (group == bake::kAlwaysOn)
      return error(ErrorKind::Usage,
                   "--lights-off: what is always on cannot be switched off: its light is in the "
                   "maps, not in a patch; {}",
                   there);
    return error(ErrorKind::Usage,
                 "--lights-off: '{}' is no group of lights in this lightmap{}; {}", group,
                 didYouMean(group, groups), there);
  }
  return {};
}

// "'lamp' of group 'desk'", "'sun', always-on"
std::string describe(const std::string& name, const std::string& group) {
  return group.empty() ? fmt::format("'{}', {}", name, bake::kAlwaysOn)
                       : fmt::format("'{}' of group '{}'", name, group);
}

Status checkScene(const lightmap::Lightmap& lightmap, const scene::Scene& scene) {
  LUCERNA_TRY_VOID(lightmap::checkFits(lightmap.layout, scene));
  for (const lightmap::LightEntry& light : lightmap.manifest.lights) {
    if (light.light >= scene.lights.size())
      return error(ErrorKind::Input,
                   "the lightmap knows light {}, '{}', and '{}' has {} lights; bake it again",
                   light.light, light.name, scene.name, scene.lights.size());
    const scene::Light& now = scene.lights[light.light];
    if (now.name != light.name || now.group != light.group)
      return error(ErrorKind::Input,
                   "light {} of '{}' is {}, and when the lightmap was baked it was {}; bake it "
                   "again",
                   light.light, scene.name, describe(now.name, now.group),
                   describe(light.name, light.group));
  }
  for (const lightmap::ObjectEntry& object : lightmap.manifest.objects)
    if (object.object >= scene.objects.size())
      return error(ErrorKind::Input,
                   "the lightmap knows object {}, '{}', and '{}' has {} objects; bake it again",
                   object.object, object.node, scene.name, scene.objects.size());
  const std::string& wanted = lightmap.manifest.geometryHash;
  if (!wanted.empty() && wanted != lightmap::hashText16(lightmap::geometryHash(scene)))
    return error(ErrorKind::Input,
                 "'{}': its objects have other shapes than when the lightmap was baked; bake it "
                 "again",
                 scene.name);
  return {};
}

// Whether the light is another one than when it was baked, on or off aside where it can be
// switched.
bool hasChanged(const scene::Scene& scene, const lightmap::LightEntry& entry) {
  if (entry.group.empty() && !scene.lights[entry.light].on) return true;
  return !entry.hash.empty() &&
         entry.hash != lightmap::hashText16(lightmap::lightHash(scene, entry.light));
}

// "'lamp' the first"
std::string theFirst(const std::string& name) {
  return name.empty() ? "one without a name the first" : fmt::format("'{}' the first", name);
}

void warnOfChangedLights(const scene::Scene& scene, const lightmap::Manifest& manifest) {
  std::vector<std::string> names;
  for (const lightmap::LightEntry& entry : manifest.lights)
    if (hasChanged(scene, entry)) names.push_back(entry.name);
  if (names.empty()) return;
  log::warning(
      "{} of the {} lights of the lightmap have changed since it was baked, {}; it shows them "
      "as they were: bake it again",
      names.size(), manifest.lights.size(), theFirst(names.front()));
}

// Of each node: whether an animation moves it or what it hangs on, playing or not.
std::vector<bool> animatedNodes(const scene::Scene& scene) {
  std::vector<bool> animated(scene.nodes.size(), false);
  for (const scene::Animation& animation : scene.animations)
    for (const scene::AnimationChannel& channel : animation.channels)
      if (channel.node != scene::kNone) animated[channel.node] = true;
  for (std::size_t i = 0; i < animated.size(); ++i)
    if (const std::uint32_t parent = scene.nodes[i].parent; parent != scene::kNone)
      animated[i] = animated[i] || animated[parent];
  return animated;
}

// The scene stands as at 0 s. A bake plays what plays unless --animation chooses: by another choice
// what is animated stands elsewhere, or by a last bit.
void warnOfMovedObjects(const scene::Scene& scene, const lightmap::Manifest& manifest,
                        bool asBaked) {
  const std::vector<bool> animated = animatedNodes(scene);
  std::vector<std::string> names;
  for (const lightmap::ObjectEntry& entry : manifest.objects)
    if (!entry.hash.empty() && (asBaked || !animated[scene.objects[entry.object].node]) &&
        entry.hash != lightmap::hashText16(lightmap::placeHash(scene, entry.object)))
      names.push_back(entry.node);
  if (names.empty()) return;
  log::warning(
      "{} of the {} objects of the lightmap have been moved, turned or scaled since it was baked, "
      "{}; light and shadows are those of where they stood: bake it again",
      names.size(), manifest.objects.size(), theFirst(names.front()));
}

// A group switches as a whole: what the scene has switched off of one that is on shines, too.
void warnOfSplitGroups(const scene::Scene& scene, const lightmap::Manifest& manifest) {
  std::set<std::string> on, off;
  for (const lightmap::LightEntry& entry : manifest.lights)
    if (!entry.group.empty()) (scene.lights[entry.light].on ? on : off).insert(entry.group);
  for (const std::string& group : off)
    if (on.contains(group))
      log::warning(
          "the group '{}' has lights that are off beside others that are on: the lightmap shows "
          "all of them; wanted groups that are on or off as a whole",
          group);
}

// Groups of which the scene has no light on.
std::vector<std::string> groupsOff(const scene::Scene& scene, const lightmap::Manifest& manifest) {
  std::vector<std::string> off = groupsOf(manifest);
  for (const lightmap::LightEntry& entry : manifest.lights)
    if (scene.lights[entry.light].on) std::erase(off, entry.group);
  return off;
}

// Ambient light is in no map. The light that a scene without any is given goes, with its ambient
// light: the maps have taken its place.
void switchOffBakedLights(scene::Scene& scene, const lightmap::Manifest& manifest,
                          const std::vector<std::string>& lightsOff) {
  for (const lightmap::LightEntry& entry : manifest.lights) {
    scene::Light& light = scene.lights[entry.light];
    if (light.on && !isAmong(lightsOff, entry.group))
      scene.ambient += scene::place(light, mat4(1.f)).ambient;
    light.on = false;
  }
  if (scene.headlight == scene::kNone) return;
  scene.lights[scene.headlight].on = false;
  scene.ambient = vec3(0.f);
}

// The maps with all groups' light but that of `off`.
Result<std::vector<Image>> mapsWith(const lightmap::Lightmap& lightmap,
                                    const std::vector<std::string>& off) {
  LUCERNA_TRY(maps, lightmap::SwitchedMaps::create(lightmap.maps, lightmap.patches));
  for (std::size_t i = 0; i < lightmap.patches.size(); ++i)
    if (const lightmap::Patch& patch = lightmap.patches[i]; !isAmong(off, patch.group))
      LUCERNA_TRY_VOID(maps.set(i, patch.color));
  maps.update();
  return maps.maps();
}

}  // namespace

Result<std::vector<Image>> takeBakedLight(scene::Scene& scene, const RenderSettings& settings) {
  auto read = lightmap::readLightmap(settings.lightmap);
  if (!read) return bake::orStopped(read.error(), settings.lightmap);
  const lightmap::Lightmap& lightmap = *read;
  LUCERNA_TRY_VOID(checkScene(lightmap, scene));
  LUCERNA_TRY_VOID(checkGroups(lightmap.manifest, settings.lightsOff));
  warnOfChangedLights(scene, lightmap.manifest);
  warnOfMovedObjects(scene, lightmap.manifest, settings.animation.empty());
  warnOfSplitGroups(scene, lightmap.manifest);
  std::vector<std::string> off = groupsOff(scene, lightmap.manifest);
  off.insert(off.end(), settings.lightsOff.begin(), settings.lightsOff.end());
  LUCERNA_TRY(maps, mapsWith(lightmap, off));
  lightmap::placeInMaps(scene, lightmap.layout);
  switchOffBakedLights(scene, lightmap.manifest, settings.lightsOff);
  return maps;
}

}  // namespace lucerna::app
