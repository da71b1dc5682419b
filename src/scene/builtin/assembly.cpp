#include "scene/builtin/assembly.hpp"

#include <cmath>

namespace lucerna::scene::builtin {

mat4 translated(vec3 offset) {
  return glm::translate(mat4(1.f), offset);
}
mat4 turnedY(float angle) {
  return glm::rotate(mat4(1.f), angle, vec3(0, 1, 0));
}

quat lookAlong(vec3 direction) {
  const vec3 back = -glm::normalize(direction);
  const vec3 hint = std::abs(back.y) < 0.999f ? vec3(0, 1, 0) : vec3(0, 0, 1);
  const vec3 right = glm::normalize(glm::cross(hint, back));
  return glm::quat_cast(mat3(right, glm::cross(back, right), back));
}

std::uint32_t addMesh(Scene& scene, Mesh mesh) {
  scene.meshes.push_back(std::move(mesh));
  return static_cast<std::uint32_t>(scene.meshes.size() - 1);
}

std::uint32_t addTexture(Scene& scene, std::string name, std::shared_ptr<const Image> image) {
  Texture texture;
  texture.name = std::move(name);
  texture.image = std::move(image);
  scene.textures.push_back(std::move(texture));
  return static_cast<std::uint32_t>(scene.textures.size() - 1);
}

std::uint32_t addCubeMap(Scene& scene, std::string name,
                         std::vector<std::shared_ptr<const Image>> faces) {
  const std::uint32_t texture = addTexture(scene, std::move(name), faces.at(0));
  scene.textures[texture].faces = std::move(faces);
  scene.textures[texture].wrapS = scene.textures[texture].wrapT = Wrap::ClampToEdge;
  return texture;
}

std::uint32_t addMaterial(Scene& scene, Material material) {
  scene.materials.push_back(std::move(material));
  return static_cast<std::uint32_t>(scene.materials.size() - 1);
}

TextureSlot slot(std::uint32_t texture) {
  TextureSlot result;
  result.texture = texture;
  return result;
}

Material matte(std::string name, vec3 albedo, float roughness) {
  Material material;
  material.name = std::move(name);
  material.albedo = vec4(albedo, 1.f);
  material.metallic = 0.f;
  material.roughness = roughness;
  return material;
}

Material textured(std::string name, std::uint32_t texture, float roughness) {
  Material material = matte(std::move(name), vec3(1.f), roughness);
  material.albedoTexture = slot(texture);
  return material;
}

std::uint32_t addObject(Scene& scene, std::uint32_t parent, std::uint32_t mesh,
                        std::uint32_t material, vec3 translation, float angleY, vec3 scale) {
  Node node;
  node.name = scene.meshes[mesh].name;
  node.parent = parent;
  node.translation = translation;
  node.rotation = glm::angleAxis(angleY, vec3(0, 1, 0));
  node.scale = scale;
  const std::uint32_t index = addNode(scene, std::move(node));
  Object object;
  object.node = index;
  object.mesh = mesh;
  object.material = material;
  scene.objects.push_back(object);
  return index;
}

void addMeshObject(Scene& scene, std::uint32_t parent, MeshBuilder& builder, std::string name,
                   std::uint32_t material) {
  if (builder.empty()) return;
  addObject(scene, parent, addMesh(scene, builder.take(std::move(name))), material);
}

void addCamera(Scene& scene, std::uint32_t parent, std::string name, vec3 position, vec3 target,
               float fovYDegrees) {
  Node node;
  node.name = name;
  node.parent = parent;
  node.translation = position;
  node.rotation = lookAlong(target - position);
  Camera camera;
  camera.name = std::move(name);
  camera.fovY = glm::radians(fovYDegrees);
  camera.node = addNode(scene, std::move(node));
  scene.cameras.push_back(std::move(camera));
}

}  // namespace lucerna::scene::builtin
