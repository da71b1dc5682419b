// The atrium's plan: what stands where, its lights, cameras and moving parts.
#include "scene/builtin/atrium.hpp"

#include <cmath>
#include <numeric>

#include "core/random.hpp"
#include "scene/builtin/assembly.hpp"

namespace lucerna::scene::builtin {
namespace {

using namespace atrium;

// Everything that the steps below share. side is -1 (left, -x) or +1; rows along z face the nave.
struct Plan {
  Scene& scene;
  AtriumMeshes mesh;
  AtriumMaterials material;
  std::uint32_t root;
  std::vector<std::uint32_t> loose;  // nodes of furniture, which moves before the building does

  std::uint32_t put(std::uint32_t meshIndex, std::uint32_t materialIndex, vec3 at,
                    float angleY = 0.f, vec3 scale = vec3(1.f)) {
    return addObject(scene, root, meshIndex, materialIndex, at, angleY, scale);
  }
  void putLoose(std::uint32_t meshIndex, std::uint32_t materialIndex, vec3 at, float angleY = 0.f,
                vec3 scale = vec3(1.f)) {
    loose.push_back(put(meshIndex, materialIndex, at, angleY, scale));
  }
};

float bayCenter(int bay) {
  return -kEnd + kBay * (static_cast<float>(bay) + 0.5f);
}

// Turns what faces local +z towards the nave.
float facingNave(float side) {
  return -side * kPi / 2;
}

void addColumns(Plan& plan) {
  const vec3 upper(0.85f, kUpperColumn / kSpringing, 0.85f);
  for (const float side : {-1.f, 1.f}) {
    for (int i = 0; i <= kBays; ++i) {
      const float z = -kEnd + kBay * static_cast<float>(i);
      plan.put(plan.mesh.columnStone, plan.material.stone, {side * kNave, 0, z});
      plan.put(plan.mesh.shaft, plan.material.marble, {side * kNave, 0, z});
      plan.put(plan.mesh.columnStone, plan.material.stone, {side * kNave, kGallery, z}, 0, upper);
      plan.put(plan.mesh.shaft, plan.material.marble, {side * kNave, kGallery, z}, 0, upper);
    }
  }
}

void addBay(Plan& plan, float side, float z) {
  const AtriumMeshes& mesh = plan.mesh;
  const AtriumMaterials& material = plan.material;
  const float turn = facingNave(side), aisle = side * (kNave + kWall) / 2;
  plan.put(mesh.lowerArch, material.stone, {side * kNave, kSpringing, z}, turn);
  plan.put(mesh.upperArch, material.stone, {side * kNave, kGallery + kUpperColumn, z}, turn);
  plan.put(mesh.balustrade, material.stone, {side * kNave, kGallery, z}, turn);
  plan.put(mesh.slab, material.stone, {side * kNave, kGallery, z}, turn);
  plan.put(mesh.aisleFloor, material.floor, {aisle, 0, z});
  plan.put(mesh.aisleCeiling, material.plaster, {aisle, kCeiling, z});
  plan.put(mesh.lowerWall, material.brick, {side * kWall, 0, z}, turn);
  plan.put(mesh.lowerTrim, material.stone, {side * kWall, 0, z}, turn);
  plan.put(mesh.upperWall, material.brick, {side * kWall, kGallery, z}, turn);
  plan.put(mesh.upperTrim, material.stone, {side * kWall, kGallery, z}, turn);
  plan.put(mesh.lattice, material.lattice, {side * kWall, kGallery, z}, turn);
  for (const float part : {-1.f, 1.f}) {
    for (const float x : {3.f, 5.f})
      plan.put(mesh.coffer, material.plaster, {side * x, kCeiling, z + part * kBay / 4});
  }
}

void addShell(Plan& plan) {
  const AtriumMeshes& mesh = plan.mesh;
  for (int bay = 0; bay < kBays; ++bay) {
    const float z = bayCenter(bay);
    for (const float side : {-1.f, 1.f}) addBay(plan, side, z);
    plan.put(mesh.naveFloor, plan.material.floor, {0, 0, z});
    plan.put(mesh.skylight, plan.material.stone, {0, kCeiling, z});
  }
  for (const float side : {-1.f, 1.f}) {
    const float turn = side < 0 ? 0.f : kPi;
    plan.put(mesh.endWall, plan.material.brick, {0, 0, side * kEnd}, turn);
    plan.put(mesh.endTrim, plan.material.stone, {0, 0, side * kEnd}, turn);
    plan.put(mesh.rose, plan.material.rose, {0, 9.f, side * (kEnd - 0.05f)}, turn);
  }
}

void addStatue(Plan& plan, vec3 at, float angleY, float scale) {
  plan.putLoose(plan.mesh.plinth, plan.material.marble, at, angleY);
  const vec3 top = at + vec3(0, 1.2f, 0);
  plan.putLoose(plan.mesh.robe, plan.material.bronze, top, angleY, vec3(scale));
  plan.putLoose(plan.mesh.head, plan.material.bronze, top, angleY, vec3(scale));
}

void addFurniture(Plan& plan) {
  const AtriumMeshes& mesh = plan.mesh;
  const AtriumMaterials& material = plan.material;
  plan.put(mesh.dais, material.stone, {0, 0, -kEnd + 1.5f});
  addStatue(plan, {0, 0.54f, -kEnd + 1.6f}, 0, 1.75f);
  for (const float side : {-1.f, 1.f}) {
    for (int bay = 0; bay < kBays; ++bay) {
      const float z = bayCenter(bay), turn = facingNave(side);
      const bool even = (bay + (side > 0 ? 1 : 0)) % 2 == 0;
      if (bay % 4 == 2) {
        addStatue(plan, {side * (kWall - 1.1f), 0, z}, turn, 1.25f);
      } else if (even) {
        plan.putLoose(mesh.vase, bay % 3 ? material.glazeBlue : material.glazeGreen,
                      {side * (kWall - 0.9f), 0, z}, 0.7f * static_cast<float>(bay), vec3(1.15f));
      } else {
        plan.putLoose(mesh.pot, material.terracotta, {side * (kNave - 1.2f), 0, z});
        plan.putLoose(mesh.plant, material.leaves, {side * (kNave - 1.2f), 0, z},
                      static_cast<float>(bay));
      }
      if (bay % 2 == 1) {
        const float x = side * (kNave - 0.9f);
        plan.putLoose(mesh.banner, even ? material.fabricRed : material.fabricBlue,
                      {x, kCeiling - 1.2f, z}, turn);
        plan.put(mesh.rod, material.iron, {x, kCeiling - 1.2f, z}, turn);
      }
    }
  }
}

void addPanes(Plan& plan) {
  for (const float side : {-1.f, 1.f})
    for (int bay = 0; bay < kBays; ++bay)
      plan.put(plan.mesh.pane, plan.material.panes[static_cast<std::size_t>(bay) % 3],
               {side * kWall, kGallery, bayCenter(bay)}, facingNave(side));
}

// Light number i hangs over the edge of the nave or the gallery and shines across the hall, so that
// most surfaces are reached by several; a third of them hang higher and shine up
// at the ceiling.
void addLight(Plan& plan, std::uint32_t i, const AtriumOptions& options, Random& random) {
  const float count = static_cast<float>(options.lights);
  const float side = i % 2 == 0 ? -1.f : 1.f;
  const bool high = (i / 2) % 3 == 1;
  const float z = (kEnd - 1.5f) * (2 * (static_cast<float>(i) + 0.5f) / count - 1);
  const vec3 position(side * random.uniform(3.2f, 4.4f), high ? 9.4f : random.uniform(5.6f, 6.6f),
                      z + random.uniform(-0.4f, 0.4f));
  vec3 target(-side * random.uniform(2.f, 7.f), high ? 12.f : 0.f, z + random.uniform(-4.f, 4.f));
  // The outermost two light the end walls.
  if (i == 0) target = {0, 6.f, -kEnd};
  if (i + 1 == options.lights) target = {0, 6.f, kEnd};
  const bool spot = options.kind == LightKind::Spot;

  Node node;
  node.name = fmt::format("light-{}", i + 1);
  node.parent = plan.root;
  node.translation = position;
  node.rotation = lookAlong(spot ? target - position : vec3(0, -1, 0));

  const std::vector<vec3> colors = atriumLightColors();
  const std::size_t color = (i + i / colors.size()) % colors.size();
  Light light;
  light.name = node.name;
  light.kind = options.kind;
  light.color = colors[color];
  // The hall stays about as bright for any number of lights.
  light.intensity = kPi * (spot ? 7.f : 3.6f) * std::sqrt(16.f / std::max(count, 4.f));
  light.attenuation = {1.f, 0.f, 0.12f};
  light.range = options.reach;
  light.radius = 0.15f;
  light.innerCone = glm::radians(20.f);
  light.outerCone = glm::radians(52.f);
  light.node = addNode(plan.scene, std::move(node));
  addObject(plan.scene, light.node, plan.mesh.lamp, plan.material.iron);
  addObject(plan.scene, light.node, plan.mesh.bulb, plan.material.bulbs[color]);
  plan.put(plan.mesh.chain, plan.material.iron, position + vec3(0, 0.4f, 0), 0,
           {1, kCeiling - position.y - 0.4f, 1});
  plan.scene.lights.push_back(std::move(light));
}

// A circle of 16 keys in 8 s, beginning where the node stands, with a slow turn.
void addMotion(Animation& animation, const Node& node, std::uint32_t index, Random& random) {
  constexpr int kKeys = 16;
  constexpr float kDuration = 8.f;
  const float radius = random.uniform(0.15f, 0.5f);
  const float turns = random.below(2) == 0 ? 1.f : -1.f;
  AnimationChannel place{index, AnimationPath::Translation, Interpolation::Linear, {}, {}};
  AnimationChannel turn{index, AnimationPath::Rotation, Interpolation::Linear, {}, {}};
  for (int key = 0; key <= kKeys; ++key) {
    const float share = static_cast<float>(key % kKeys) / kKeys;
    const float angle = 2 * kPi * share * turns;
    place.times.push_back(kDuration * static_cast<float>(key) / kKeys);
    place.values.emplace_back(
        node.translation + radius * vec3(std::cos(angle) - 1, 0, std::sin(angle)), 0.f);
    const quat q = glm::angleAxis(angle, vec3(0, 1, 0)) * node.rotation;
    turn.values.emplace_back(q.x, q.y, q.z, q.w);
  }
  turn.times = place.times;
  animation.channels.push_back(std::move(place));
  animation.channels.push_back(std::move(turn));
}

// Furniture first, then anything that no light hangs on, in a seeded order.
void addAnimation(Plan& plan, const AtriumOptions& options) {
  const Scene& scene = plan.scene;
  const auto wanted = static_cast<std::size_t>(
      std::lround(options.moving * static_cast<float>(scene.objects.size())));
  if (wanted == 0) return;
  Random random(options.seed, 2);
  std::vector<bool> chosen(scene.nodes.size(), false);
  std::vector<std::uint32_t> order;
  const auto appendShuffled = [&](std::vector<std::uint32_t> nodes) {
    for (std::size_t i = nodes.size(); i > 1; --i)
      std::swap(nodes[i - 1], nodes[random.below(static_cast<std::uint32_t>(i))]);
    for (const std::uint32_t node : nodes) {
      if (!chosen[node]) order.push_back(node);
      chosen[node] = true;
    }
  };
  appendShuffled(plan.loose);
  std::vector<std::uint32_t> all;
  for (const Object& object : scene.objects) all.push_back(object.node);
  appendShuffled(std::move(all));
  Animation animation;
  animation.name = "moving";
  for (std::size_t i = 0; i < std::min(wanted, order.size()); ++i)
    addMotion(animation, scene.nodes[order[i]], order[i], random);
  plan.scene.animations.push_back(std::move(animation));
}

}  // namespace

Scene makeAtrium(const AtriumOptions& options) {
  Scene scene;
  scene.name = "builtin:atrium";
  Node root;
  root.name = "atrium";
  const std::uint32_t rootIndex = addNode(scene, std::move(root));
  Plan plan{scene, addAtriumMeshes(scene), addAtriumMaterials(scene, options), rootIndex, {}};
  addColumns(plan);
  addShell(plan);
  addFurniture(plan);
  if (options.glass) addPanes(plan);
  Random random(options.seed, 1);
  for (std::uint32_t i = 0; i < options.lights; ++i) addLight(plan, i, options, random);
  addAnimation(plan, options);

  addCamera(scene, rootIndex, "main", {1.7f, 1.8f, 19.5f}, {-0.8f, 5.4f, -10.f}, 62);
  addCamera(scene, rootIndex, "gallery", {5.6f, 9.3f, 15.6f}, {-3.2f, 5.6f, -8.f}, 60);
  addCamera(scene, rootIndex, "detail", {7.3f, 1.8f, 13.8f}, {8.9f, 2.1f, 8.f}, 52);
  scene.background.color = {0.010f, 0.018f, 0.045f};
  scene.ambient = vec3(0.040f, 0.042f, 0.055f);
  return scene;
}

}  // namespace lucerna::scene::builtin
