#include "render/gpu_scene.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "core/math/transform.hpp"
#include "render/blocks.hpp"
#include "render/upload.hpp"

namespace lucerna::render {
namespace {

// Scenes are loaded one after the other into the same GpuScene, so each counts on from the last.
std::uint64_t nextRevision() {
  static std::atomic<std::uint64_t> revision = 0;
  return ++revision;
}

bool flipsOrientation(const mat4& worldFromObject) {
  return glm::determinant(mat3(worldFromObject)) < 0.f;
}

blocks::ObjectValues objectValues(const scene::Scene& scene, const scene::Object& object) {
  const mat4& worldFromObject = scene.nodes[object.node].worldFromNode;
  // Scaled so that the shader's normalisation neither overflows nor underflows.
  mat3 normals = normalMatrix(mat3(worldFromObject));
  float largest = 0.f;
  for (int column = 0; column < 3; ++column)
    largest = std::max(largest, glm::length(normals[column]));
  if (largest > 0.f) normals *= 1.f / largest;
  return {.worldFromObject = worldFromObject,
          .normalMatrix0 = vec4(normals[0], 0.f),
          .normalMatrix1 = vec4(normals[1], 0.f),
          .normalMatrix2 = vec4(normals[2], 0.f),
          .info = uvec4(flipsOrientation(worldFromObject) ? 1 : 0, 0, 0, 0)};
}

blocks::TextureUse textureUse(const scene::TextureSlot& slot) {
  const float c = std::cos(slot.rotation);
  const float s = std::sin(slot.rotation);
  // Counter-clockwise as one sees it, with v pointing down: (1, 0) turns to (c, -s).
  return {.matrix = vec4(c * slot.scale.x, -s * slot.scale.x, s * slot.scale.y, c * slot.scale.y),
          .offset = vec4(slot.offset, slot.texCoord == 1 ? 1.f : 0.f, slot.used() ? 1.f : 0.f)};
}

// As render/surface.glsl numbers them.
float materialType(scene::MaterialModel model) {
  switch (model) {
    case scene::MaterialModel::Phong:
      return 1.f;
    case scene::MaterialModel::MetallicRoughness:
      return 2.f;
    case scene::MaterialModel::Unlit:
      return 4.f;
    case scene::MaterialModel::SpecularGlossiness:
      return 5.f;
  }
  return 0.f;
}

// As render/texture_environment.glsl numbers them.
float combineCode(const scene::Scene& scene, const scene::Material& m) {
  constexpr float kReplaceColor = 5.f;
  if (m.combine != scene::Combine::Replace || !m.albedoTexture.used())
    return static_cast<float>(m.combine);
  const bool hasAlpha = scene.textures[m.albedoTexture.texture].image->channels() % 2 == 0;
  return hasAlpha ? static_cast<float>(m.combine) : kReplaceColor;
}

// What the model ignores is 0, or 1 for roughness.
blocks::MaterialValues materialValues(const scene::Scene& scene, const scene::Material& m) {
  using Model = scene::MaterialModel;
  const bool lit = m.model != Model::Unlit;
  const bool rough = m.model == Model::MetallicRoughness || m.model == Model::SpecularGlossiness;
  const bool specular = m.model == Model::Phong || m.model == Model::SpecularGlossiness;
  return {.albedo = m.albedo,
          .emissive = vec4(lit ? m.emissive : vec3(0.f), m.normalScale),
          .transmission = vec4(m.transmission, m.alphaCutoff),
          .specular = vec4(specular ? m.specular : vec3(0.f), m.shininess),
          .surface = vec4(m.model == Model::MetallicRoughness ? m.metallic : 0.f,
                          rough ? m.roughness : 1.f, m.occlusionStrength, materialType(m.model)),
          .albedoUse = textureUse(m.albedoTexture),
          .emissiveUse = textureUse(m.emissiveTexture),
          .normalUse = textureUse(m.normalTexture),
          .metallicRoughnessUse = textureUse(m.metallicRoughnessTexture),
          .occlusionUse = textureUse(m.occlusionTexture),
          .specularUse = textureUse(m.specularTexture),
          .codes = vec4(m.shader.used() ? 1.f : 0.f, combineCode(scene, m),
                        static_cast<float>(m.albedoTexture.coordinates),
                        static_cast<float>(m.emissiveTexture.coordinates)),
          .blendColor = vec4(m.blendColor, 0.f),
          .albedoGeneration = {m.albedoTexture.planeS, m.albedoTexture.planeT},
          .emissiveGeneration = {m.emissiveTexture.planeS, m.emissiveTexture.planeT},
          .unused = {}};
}

// Blocks of no elements cannot be bound: there is always one.
template <typename T>
std::span<const std::byte> bytesOf(std::vector<T>& values) {
  values.resize(std::max<std::size_t>(values.size(), 1));
  return std::as_bytes(std::span(values));
}

void uploadObjects(gpu::Device& device, GpuScene& gpuScene) {
  const scene::Scene& scene = *gpuScene.scene;
  std::vector<blocks::ObjectValues> values;
  gpuScene.mirrored.clear();
  for (const scene::Object& object : scene.objects) {
    values.push_back(objectValues(scene, object));
    gpuScene.mirrored.push_back(flipsOrientation(scene.nodes[object.node].worldFromNode));
  }
  device.write(gpuScene.objects, bytesOf(values), "ObjectBlock");
}

void uploadMaterials(gpu::Device& device, GpuScene& gpuScene) {
  std::vector<blocks::MaterialValues> values;
  for (const scene::Material& material : gpuScene.scene->materials)
    values.push_back(materialValues(*gpuScene.scene, material));
  device.write(gpuScene.materials, bytesOf(values), "MaterialBlock");
}

void buildBvh(GpuScene& gpuScene) {
  std::vector<Aabb> boxes;
  for (const scene::Object& object : gpuScene.scene->objects) boxes.push_back(object.boundsW);
  gpuScene.bvh.build(boxes);
}

}  // namespace

void upload(gpu::Device& device, GpuScene& gpuScene, const scene::Scene& scene) {
  gpuScene.scene = &scene;
  gpuScene.changes = {.everything = true, .movedObjects = {}, .lights = true, .materials = true};
  gpuScene.geometryRevision = nextRevision();
  uploadGeometry(device, gpuScene);
  uploadTextures(device, gpuScene);
  uploadMaterials(device, gpuScene);
  uploadObjects(device, gpuScene);
  buildBvh(gpuScene);
}

void updateMoved(gpu::Device& device, GpuScene& gpuScene, std::span<const std::uint32_t> moved) {
  if (moved.empty()) return;
  auto& known = gpuScene.changes.movedObjects;
  known.insert(known.end(), moved.begin(), moved.end());
  gpuScene.geometryRevision = nextRevision();
  uploadBentMeshes(device, gpuScene);
  uploadObjects(device, gpuScene);
  std::vector<Aabb> boxes;
  for (const std::uint32_t object : moved) boxes.push_back(gpuScene.scene->objects[object].boundsW);
  gpuScene.bvh.refit(moved, boxes);
}

}  // namespace lucerna::render
