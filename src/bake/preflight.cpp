#include "bake/preflight.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <unordered_set>

#include "bake/hidden.hpp"
#include "bake/shadow_tracer.hpp"
#include "bake/triangle.hpp"
#include "core/hash.hpp"

namespace lucerna::bake {
namespace {

using Corners = std::array<vec3, 3>;

Corners cornersOf(const World& world, std::size_t triangle) {
  Corners corners;
  for (std::size_t k = 0; k < 3; ++k)
    corners[k] = world.positions[world.indices[3 * triangle + k]] + 0.f;  // no -0
  return corners;
}

// The corners in an order of their own, so that turned and flipped triangles are alike.
struct Key {
  std::array<std::uint32_t, 9> bits{};
  bool operator==(const Key&) const = default;
};
struct KeyHash {
  std::size_t operator()(const Key& key) const {
    return hashBytes(std::as_bytes(std::span(key.bits)));
  }
};
Key keyOf(Corners corners) {
  std::ranges::sort(corners, [](vec3 a, vec3 b) {
    return std::array{a.x, a.y, a.z} < std::array{b.x, b.y, b.z};
  });
  Key key;
  static_assert(sizeof key.bits == sizeof corners);
  std::memcpy(key.bits.data(), corners.data(), sizeof corners);
  return key;
}

void countTriangles(const World& world, Preflight& result) {
  std::unordered_set<Key, KeyHash> known;
  known.reserve(world.triangleCount());
  for (std::size_t i = 0; i < world.triangleCount(); ++i) {
    const Corners c = cornersOf(world, i);
    if (!isFinite(c[0]) || !isFinite(c[1]) || !isFinite(c[2]))
      ++result.notFinite;
    else if (shapeOf(c).area == 0.f)
      ++result.degenerate;
    else if (!known.insert(keyOf(c)).second)
      ++result.duplicate;
  }
}

std::vector<bool> movingNodes(const scene::Scene& scene) {
  std::vector<bool> moving(scene.nodes.size(), false);
  for (const scene::Animation& animation : scene.animations) {
    if (!animation.playing) continue;
    for (const scene::AnimationChannel& channel : animation.channels)
      if (channel.path != scene::AnimationPath::Weights) moving[channel.node] = true;
  }
  for (std::size_t i = 0; i < scene.nodes.size(); ++i)  // parents stand before their children
    if (const std::uint32_t parent = scene.nodes[i].parent; parent != scene::kNone)
      moving[i] = moving[i] || moving[parent];
  return moving;
}

void countObjects(const World& world, Preflight& result) {
  const scene::Scene& scene = *world.scene;
  const std::vector<bool> moving = movingNodes(scene);
  for (const WorldObject& each : world.objects) {
    const scene::Object& object = scene.objects[each.object];
    if (!each.receives) ++result.unlit;
    if (object.skin != scene::kNone || !scene.meshes[object.mesh].targets.empty())
      ++result.bending;
    else if (moving[object.node])
      ++result.moving;
  }
}

void askLights(const Plan& plan, Preflight& result) {
  std::vector<std::uint32_t> lamps;  // of the scene's lights
  std::vector<vec3> placesW;
  for (const LightGroup& group : plan.groups)
    for (const scene::PlacedLight& light : group.lights) {
      if (light.light == scene::kNone) continue;  // of the sky
      ++result.lights;
      if (light.kind == scene::LightKind::Directional) continue;
      lamps.push_back(light.light);
      placesW.push_back(light.positionW);
    }
  if (lamps.empty()) return;
  const trace::RayScene rays(*plan.world.scene, mat4(1.f), rayInstructionSet());
  const std::vector<bool> inside = insideSolids(rays, placesW);
  for (std::size_t i = 0; i < lamps.size(); ++i)
    if (inside[i]) result.buried.push_back(plan.world.scene->lights[lamps[i]].name);
}

}  // namespace

std::vector<std::string> Preflight::sentences() const {
  std::vector<std::string> list;
  if (duplicate > 0)
    list.push_back(
        fmt::format("{} triangles lie exactly on others; each takes texels of its own", duplicate));
  if (unlit > 0) list.push_back(fmt::format("{} objects are unlit and get no light", unlit));
  if (moving > 0)
    list.push_back(fmt::format(
        "{} objects move; they are lit, and throw shadows, where they stand at 0 s", moving));
  if (bending > 0)
    list.push_back(fmt::format(
        "{} objects bend; they throw the shadows of 0 s, and show no baked light", bending));
  if (!buried.empty())
    list.push_back(fmt::format(
        "{} lights are inside of solids and light nothing outside: {}", buried.size(),
        fmt::join(std::span(buried).first(std::min<std::size_t>(buried.size(), 10)), ", ")));
  return list;
}

Preflight inspect(const Plan& plan) {
  Preflight result;
  result.shrunk = plan.charts.shrunk;
  countTriangles(plan.world, result);
  result.huge = plan.world.huge;
  result.notFinite -= result.huge;
  countObjects(plan.world, result);
  askLights(plan, result);
  return result;
}

}  // namespace lucerna::bake
