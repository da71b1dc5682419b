#include "scene/builtin/cornell.hpp"

#include <cmath>

#include "scene/builtin/assembly.hpp"

namespace lucerna::scene::builtin {
namespace {

constexpr vec3 kWhite{0.725f, 0.71f, 0.68f}, kRed{0.63f, 0.065f, 0.05f},
    kGreen{0.14f, 0.45f, 0.091f};
constexpr vec3 kLampRadiance{17.f, 12.f, 4.f};

using Corners = std::array<vec3, 4>;

void addSide(Scene& scene, std::uint32_t root, const char* name, vec3 albedo,
             const Corners& corners) {
  MeshBuilder builder;
  builder.quad(corners);
  Material material = matte(name, albedo, 1.f);
  material.model = MaterialModel::Phong;  // without a highlight: Lambert
  addMeshObject(scene, root, builder, name, addMaterial(scene, material));
}

// A box upright on the floor; base: counter-clockwise seen from above.
void addBox(Scene& scene, std::uint32_t root, const char* name, const std::array<vec2, 4>& base,
            float height) {
  const auto at = [&](std::size_t i, float y) { return vec3(base[i % 4].x, y, base[i % 4].y); };
  MeshBuilder builder;
  builder.quad({at(0, height), at(1, height), at(2, height), at(3, height)});
  builder.quad({at(3, 0), at(2, 0), at(1, 0), at(0, 0)});
  for (std::size_t i = 0; i < 4; ++i)
    builder.quad({at(i, 0), at(i + 1, 0), at(i + 1, height), at(i, height)});
  Material material = matte(name, kWhite, 1.f);
  material.model = MaterialModel::Phong;
  addMeshObject(scene, root, builder, name, addMaterial(scene, material));
}

void addLamp(Scene& scene, std::uint32_t root) {
  constexpr float kLeft = -0.24f, kRight = 0.23f, kBack = -0.22f, kFront = 0.16f, kHeight = 1.98f;
  addSide(scene, root, "light", vec3(0.78f),
          {vec3(kLeft, kHeight, kFront), vec3(kLeft, kHeight, kBack), vec3(kRight, kHeight, kBack),
           vec3(kRight, kHeight, kFront)});
  scene.materials.back().emissive = kLampRadiance;

  constexpr float kArea = (kRight - kLeft) * (kFront - kBack);
  Light light;
  light.name = "lamp";
  light.kind = LightKind::Spot;
  // A surface of radiance L and area A shines with L A cos(angle to its normal).
  light.intensity = kLampRadiance.x * kArea;
  light.color = kLampRadiance / kLampRadiance.x;
  light.exponent = 1.f;
  light.innerCone = light.outerCone = 0.5f * kPi;
  light.radius = std::sqrt(kArea / kPi);
  Node node;
  node.name = light.name;
  node.parent = root;
  node.translation = {0.5f * (kLeft + kRight), kHeight, 0.5f * (kBack + kFront)};
  node.rotation = lookAlong(vec3(0, -1, 0));
  light.node = addNode(scene, std::move(node));
  scene.lights.push_back(std::move(light));
}

}  // namespace

Scene makeCornell(const CornellOptions& options) {
  Scene scene;
  Node rootNode;
  rootNode.name = "cornell";
  const std::uint32_t root = addNode(scene, std::move(rootNode));
  // The measured box is no perfect cube.
  addSide(scene, root, "floor", kWhite,
          {vec3(-1.01f, 0, 0.99f), vec3(1, 0, 0.99f), vec3(1, 0, -1.04f), vec3(-0.99f, 0, -1.04f)});
  addSide(scene, root, "ceiling", kWhite,
          {vec3(-1.02f, 1.99f, 0.99f), vec3(-1.02f, 1.99f, -1.04f), vec3(1, 1.99f, -1.04f),
           vec3(1, 1.99f, 0.99f)});
  addSide(scene, root, "backWall", kWhite,
          {vec3(-0.99f, 0, -1.04f), vec3(1, 0, -1.04f), vec3(1, 1.99f, -1.04f),
           vec3(-1.02f, 1.99f, -1.04f)});
  addSide(scene, root, "rightWall", kGreen,
          {vec3(1, 0, -1.04f), vec3(1, 0, 0.99f), vec3(1, 1.99f, 0.99f), vec3(1, 1.99f, -1.04f)});
  addSide(scene, root, "leftWall", kRed,
          {vec3(-1.01f, 0, 0.99f), vec3(-0.99f, 0, -1.04f), vec3(-1.02f, 1.99f, -1.04f),
           vec3(-1.02f, 1.99f, 0.99f)});
  if (options.boxes) {
    addBox(scene, root, "shortBox",
           {vec2(0.53f, 0.75f), vec2(0.70f, 0.17f), vec2(0.13f, 0.f), vec2(-0.05f, 0.57f)}, 0.6f);
    addBox(scene, root, "tallBox",
           {vec2(-0.53f, 0.09f), vec2(0.04f, -0.09f), vec2(-0.14f, -0.67f), vec2(-0.71f, -0.49f)},
           1.2f);
  }
  addLamp(scene, root);
  scene.bake.areaLights = false;  // the lamp stands for the surface that shines
  scene.ambient = vec3(options.ambient);
  scene.background.color = vec3(0);
  addCamera(scene, root, "main", {0, 0.99f, 3.87f}, {0, 0.99f, 0}, 39.3f);
  return scene;
}

}  // namespace lucerna::scene::builtin
