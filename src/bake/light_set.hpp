// The lights of a bake, by the groups that switch together.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "scene/bvh.hpp"
#include "scene/scene.hpp"

namespace lucerna::bake {

// What `--lights`, and messages, call the lights without a group.
inline constexpr const char* kAlwaysOn = "always-on";

struct LightGroup {
  std::string name;  // "": always on
  std::vector<scene::PlacedLight> lights;
};

// The group "" first, even if it is empty, then the others by name. Lights of groups take part
// even where the scene has switched them off: groups are for switching. The headlight, which goes
// with the camera, does not. mostReach: m; no light reaches farther.
std::vector<LightGroup> groupLights(const scene::Scene& scene, float mostReach);

// The boxes that the lights' light stays in, as a tree: what it finds for a box are all lights that
// may reach it, and few others.
scene::Bvh reachTree(std::span<const scene::PlacedLight> lights);

// A sky of one radiance, as directional lights that are spread evenly over all directions; each is
// as large as its share of the sphere, so that shadows' edges run into each other. They are none of
// the scene's: their PlacedLight::light is kNone. directions: 2 or more.
std::vector<scene::PlacedLight> skyLights(vec3 radiance, int directions);
bool isOfSky(const scene::PlacedLight& light);

}  // namespace lucerna::bake
