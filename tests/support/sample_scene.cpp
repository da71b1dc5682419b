#include <array>

#include "support/testing.hpp"

namespace lucerna::testing {
namespace {

// A checkerboard whose dark squares are see-through.
scene::Texture checkerboard() {
  constexpr int kSide = 64;
  Image image(kSide, kSide, 4, ComponentType::U8);
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      const bool light = ((x / 8) + (y / 8)) % 2 == 0;
      std::uint8_t* texel = image.pixel<std::uint8_t>(x, y);
      texel[0] = light ? 230 : 40;
      texel[1] = light ? 210 : 60;
      texel[2] = light ? 180 : 90;
      texel[3] = light ? 255 : 0;
    }
  scene::Texture texture;
  texture.name = "checkerboard";
  texture.image = std::make_shared<const Image>(std::move(image));
  return texture;
}

std::vector<scene::Material> sampleMaterials() {
  using scene::MaterialModel;
  std::vector<scene::Material> materials(7);
  scene::Material& floor = materials[0];
  floor.name = "floor";
  floor.metallic = 0.f;
  floor.roughness = 0.8f;
  floor.albedo = {0.7f, 0.68f, 0.62f, 1.f};
  scene::Material& phong = materials[1];
  phong.name = "phong";
  phong.model = MaterialModel::Phong;
  phong.albedo = {0.7f, 0.2f, 0.15f, 1.f};
  phong.specular = vec3(0.6f);
  phong.shininess = 40.f;
  scene::Material& metal = materials[2];
  metal.name = "metal";
  metal.albedo = {0.95f, 0.75f, 0.35f, 1.f};
  metal.roughness = 0.35f;
  scene::Material& fence = materials[3];
  fence.name = "fence";
  fence.metallic = 0.f;
  fence.alphaMode = scene::AlphaMode::Mask;
  fence.doubleSided = true;
  fence.albedoTexture.texture = 0;
  scene::Material& glass = materials[4];
  glass.name = "glass";
  glass.metallic = 0.f;
  glass.roughness = 0.2f;
  glass.alphaMode = scene::AlphaMode::Blend;
  glass.albedo = {0.2f, 0.5f, 0.8f, 0.35f};
  glass.transmission = {0.6f, 0.8f, 1.f};
  scene::Material& lamp = materials[5];
  lamp.name = "lamp";
  lamp.albedo = {0.1f, 0.1f, 0.1f, 1.f};
  lamp.emissive = {2.f, 1.5f, 0.6f};
  scene::Material& lava = materials[6];
  lava.name = "lava";
  lava.metallic = 0.f;
  lava.shader = {.file = "render/custom/lava.frag",
                 .textures = {{.name = "grain", .texture = 0, .data = true}}};
  return materials;
}

void addLights(scene::Scene& scene) {
  scene::Light sun;
  sun.name = "sun";
  sun.kind = scene::LightKind::Directional;
  sun.intensity = 1.2f;
  addLight(scene, sun, {3, 8, 4}, {0, 0, 0});
  scene::Light point;
  point.name = "point";
  point.color = {1.f, 0.5f, 0.2f};
  point.intensity = 6.f;
  point.range = 6.f;
  addLight(scene, point, {-1.5f, 1.8f, 1.f}, {0, 0, 0});
  scene::Light spot;
  spot.name = "spot";
  spot.kind = scene::LightKind::Spot;
  spot.color = {0.3f, 0.5f, 1.f};
  spot.intensity = 40.f;
  spot.innerCone = 0.2f;
  spot.outerCone = 0.5f;
  addLight(scene, spot, {2.5f, 3.f, 2.f}, {0.5f, 0, 0});
}

}  // namespace

scene::Mesh cubeMesh() {
  scene::Mesh mesh;
  mesh.name = "cube";
  for (int axis = 0; axis < 3; ++axis)
    for (const float side : {-1.f, 1.f}) {
      vec3 normal(0.f), u(0.f);
      normal[axis] = side;
      u[(axis + 1) % 3] = 1.f;
      const vec3 v = glm::cross(normal, u);
      const auto first = static_cast<std::uint32_t>(mesh.positions.size());
      for (const vec2 corner : {vec2(-1, -1), vec2(1, -1), vec2(1, 1), vec2(-1, 1)}) {
        mesh.positions.push_back(0.5f * (normal + corner.x * u + corner.y * v));
        mesh.normals.push_back(normal);
        mesh.tangents.emplace_back(u, -1.f);
        mesh.texCoords[0].push_back({0.5f + 0.5f * corner.x, 0.5f - 0.5f * corner.y});
        mesh.bounds.grow(mesh.positions.back());
      }
      for (const std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) mesh.indices.push_back(first + i);
    }
  return mesh;
}

void addObject(scene::Scene& scene, std::uint32_t mesh, std::uint32_t material,
               const mat4& worldFromObject) {
  const std::uint32_t node = addNode(scene, "object", worldFromObject);
  scene.objects.push_back({.node = node, .mesh = mesh, .material = material, .boundsW = {}});
}

void addBox(scene::Scene& scene, vec3 middle, vec3 sides, std::uint32_t material) {
  scene.meshes.push_back(cubeMesh());
  addObject(scene, static_cast<std::uint32_t>(scene.meshes.size() - 1), material,
            glm::scale(glm::translate(mat4(1.f), middle), sides));
}

void addCamera(scene::Scene& scene, vec3 eye, vec3 target, float fovY) {
  scene::Camera camera;
  camera.name = "camera";
  camera.fovY = fovY;
  camera.near = 0.1f;
  camera.far = 100.f;
  camera.node = addNode(scene, "camera", glm::inverse(glm::lookAt(eye, target, vec3(0, 1, 0))));
  scene.cameras.push_back(camera);
}

void addLight(scene::Scene& scene, scene::Light light, vec3 eye, vec3 target) {
  const vec3 up = glm::normalize(vec3(0.1f, 1.f, 0.2f));  // never along a test's light
  light.node = addNode(scene, light.name, glm::inverse(glm::lookAt(eye, target, up)));
  scene.lights.push_back(std::move(light));
}

scene::Scene emptyScene() {
  scene::Scene scene;
  scene.name = "empty scene";
  scene.background.color = vec3(0.f);
  scene.meshes.push_back(cubeMesh());
  addCamera(scene, {0, 0, 0}, {0, 0, -1});
  return scene;
}

scene::Material& addWall(scene::Scene& scene, float distance) {
  constexpr float kThickness = 0.02f;  // m; the front side is at `distance`
  const vec3 center(0, 0, -distance - 0.5f * kThickness);
  const mat4 place = glm::translate(mat4(1.f), center);
  scene::Material& material = scene.materials.emplace_back();
  material.metallic = 0.f;
  addObject(scene, 0, static_cast<std::uint32_t>(scene.materials.size() - 1),
            glm::scale(place, vec3(10.f, 10.f, kThickness)));
  updateTransforms(scene);
  return material;
}

scene::Scene sampleScene() {
  scene::Scene scene;
  scene.name = "sample scene";
  scene.ambient = vec3(0.08f, 0.09f, 0.1f);
  scene.meshes.push_back(cubeMesh());
  scene.textures.push_back(checkerboard());
  scene.materials = sampleMaterials();
  const auto place = [&](std::uint32_t material, vec3 position, vec3 scale) {
    addObject(scene, 0, material, glm::scale(glm::translate(mat4(1.f), position), scale));
  };
  place(0, {0, -0.05f, 0}, {8, 0.1f, 8});
  place(1, {-1.6f, 0.5f, 0}, vec3(1.f));
  place(2, {0, 0.5f, 0}, {1.f, 1.f, -1.f});  // a mirror image
  place(3, {1.5f, 0.6f, -0.4f}, {1.2f, 1.2f, 0.05f});
  place(4, {-0.4f, 0.5f, 1.5f}, {0.8f, 1.f, 0.1f});
  place(4, {0.5f, 0.5f, 2.f}, {0.8f, 1.f, 0.1f});
  place(5, {0.4f, 1.2f, -1.5f}, vec3(0.3f));
  place(6, {-1.3f, 0.3f, 1.4f}, vec3(0.6f));
  addLights(scene);
  addCamera(scene, {0.5f, 2.f, 5.f}, {0, 0.4f, 0});
  updateTransforms(scene);
  return scene;
}

}  // namespace lucerna::testing
