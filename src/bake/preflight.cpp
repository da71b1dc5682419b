#include "bake/preflight.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <unordered_set>

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

// Which way a ray first meets a surface: +1 its front, -1 its back, 0 none.
int firstSide(const World& world, vec3 origin, vec3 direction) {
  float nearest = std::numeric_limits<float>::infinity();
  int side = 0;
  for (std::size_t i = 0; i < world.triangleCount(); ++i) {
    const Corners c = cornersOf(world, i);
    const vec3 u = c[1] - c[0], v = c[2] - c[0];
    const vec3 p = glm::cross(direction, v);
    const float determinant = glm::dot(u, p);  // Moeller and Trumbore, 1997
    if (determinant == 0.f) continue;
    const vec3 from = origin - c[0], q = glm::cross(from, u);
    const float a = glm::dot(from, p) / determinant, b = glm::dot(direction, q) / determinant;
    const float distance = glm::dot(v, q) / determinant;
    if (!(a >= 0.f && b >= 0.f && a + b <= 1.f && distance > 0.f && distance < nearest)) continue;
    nearest = distance;
    side = (determinant > 0.f) != world.objects[world.owners[i]].mirrored ? 1 : -1;
  }
  return side;
}

bool seesBacksOnly(const World& world, vec3 origin) {
  for (const float x : {-1.f, 1.f})
    for (const float y : {-1.f, 1.f})
      for (const float z : {-1.f, 1.f})
        // Askew, so that they meet no edges of boxes.
        if (firstSide(world, origin, vec3(x, 0.7f * y, 0.43f * z)) >= 0) return false;
  return true;
}

void askLights(const Plan& plan, Preflight& result) {
  constexpr double kMostTests = 2e8;  // about a second
  constexpr double kRays = 3.;        // of most lights the first says it
  const double most = kMostTests / (kRays * static_cast<double>(plan.world.triangleCount()) + 1.);
  double asked = 0.;
  for (const LightGroup& group : plan.groups)
    for (const scene::PlacedLight& light : group.lights) {
      if (light.light == scene::kNone) continue;  // of the sky
      ++result.lights;
      if (light.kind == scene::LightKind::Directional) continue;
      if (++asked > most)
        ++result.notAsked;
      else if (seesBacksOnly(plan.world, light.positionW))
        result.buried.push_back(plan.world.scene->lights[light.light].name);
    }
}

}  // namespace

std::vector<std::string> Preflight::sentences() const {
  std::vector<std::string> list;
  if (notFinite > 0)
    list.push_back(fmt::format("{} triangles have corners that are no numbers", notFinite));
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
  if (notAsked > 0)
    list.push_back(
        fmt::format("{} lights were not asked whether they are inside of solids", notAsked));
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
