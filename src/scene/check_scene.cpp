#include "scene/check_scene.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace lucerna::scene {
namespace {

bool finite(std::span<const float> values) {
  return std::all_of(values.begin(), values.end(), [](float v) { return std::isfinite(v); });
}

template <int N>
bool finite(const glm::vec<N, float>& v) {
  return finite(std::span<const float>(glm::value_ptr(v), N));
}

bool finite(const quat& q) {
  return finite(vec4(q.x, q.y, q.z, q.w));
}

bool finite(const mat4& m) {
  return finite(std::span<const float>(glm::value_ptr(m), 16));
}

template <typename T>
bool finiteStream(const std::vector<T>& stream) {
  return finite(std::span<const float>(reinterpret_cast<const float*>(stream.data()),
                                       stream.size() * sizeof(T) / sizeof(float)));
}

Error fault(const char* kind, std::size_t index, const char* what) {
  return error(ErrorKind::Input, "{} {}: {}", kind, index, what);
}

// Morph targets and joints.
Status checkBending(const Mesh& mesh, std::size_t index) {
  const std::size_t count = mesh.positions.size();
  const auto good = [&](const auto& stream) {
    return (stream.empty() || stream.size() == count) && finiteStream(stream);
  };
  for (const MorphTarget& target : mesh.targets)
    if (!good(target.positions) || !good(target.normals) || !good(target.tangents) ||
        !good(target.texCoords[0]) || !good(target.texCoords[1]) || !good(target.colors))
      return fault("mesh", index, "a morph target is not as long as the positions, or not finite");
  const Influences& influences = mesh.influences;
  if (influences.joints.size() != count * influences.perVertex ||
      influences.weights.size() != count * influences.perVertex || !finite(influences.weights))
    return fault("mesh", index, "joints or weights are not as many as stated, or not finite");
  return {};
}

Status checkMesh(const Mesh& mesh, std::size_t index) {
  const std::size_t count = mesh.positions.size();
  const auto fits = [&](const auto& stream) { return stream.empty() || stream.size() == count; };
  if (!fits(mesh.normals) || !fits(mesh.tangents) || !fits(mesh.texCoords[0]) ||
      !fits(mesh.texCoords[1]) || !fits(mesh.colors))
    return fault("mesh", index, "a stream is not as long as the positions");
  if (mesh.indices.size() % 3 != 0) return fault("mesh", index, "indices are no triangles");
  if (mesh.lines.size() % 2 != 0) return fault("mesh", index, "indices are no lines");
  for (const auto* list : {&mesh.indices, &mesh.lines, &mesh.points})
    for (const std::uint32_t i : *list)
      if (i >= count) return fault("mesh", index, "an index is out of range");
  if (!finiteStream(mesh.positions) || !finiteStream(mesh.normals) ||
      !finiteStream(mesh.tangents) || !finiteStream(mesh.texCoords[0]) ||
      !finiteStream(mesh.texCoords[1]))
    return fault("mesh", index, "a vertex holds a value that is not a finite number");
  return checkBending(mesh, index);
}

bool goodSlot(const TextureSlot& slot, std::size_t textureCount) {
  return (!slot.used() || slot.texture < textureCount) &&
         (slot.texCoord == 0 || slot.texCoord == 1) && finite(slot.offset) && finite(slot.scale) &&
         std::isfinite(slot.rotation);
}

Status checkMaterial(const Material& m, std::size_t index, std::size_t textureCount) {
  for (const TextureSlot* slot :
       {&m.albedoTexture, &m.emissiveTexture, &m.normalTexture, &m.metallicRoughnessTexture,
        &m.occlusionTexture, &m.specularTexture})
    if (!goodSlot(*slot, textureCount))
      return fault("material", index, "a texture slot is out of range");
  const float numbers[] = {m.alphaCutoff, m.normalScale, m.metallic,
                           m.roughness,   m.shininess,   m.occlusionStrength};
  if (!finite(numbers) || !finite(m.albedo) || !finite(m.emissive) || !finite(m.transmission) ||
      !finite(m.specular))
    return fault("material", index, "a value is not a finite number");
  return {};
}

Status checkNode(const Node& node, std::size_t index) {
  if (node.parent != kNone && node.parent >= index)
    return fault("node", index, "its parent stands behind it");
  if (!finite(node.translation) || !finite(node.scale) || !finite(node.rotation) ||
      (node.matrix && !finite(*node.matrix)))
    return fault("node", index, "its transform is not finite");
  return {};
}

Status checkChannel(const AnimationChannel& channel, std::size_t index, std::size_t nodeCount) {
  const std::size_t keys =
      channel.times.size() * (channel.interpolation == Interpolation::CubicSpline ? 3 : 1);
  if (channel.node >= nodeCount) return fault("animation", index, "a node is out of range");
  const bool fits = channel.path == AnimationPath::Weights
                        ? keys > 0 && channel.weights.size() % keys == 0
                        : channel.values.size() == keys;
  if (!fits) return fault("animation", index, "keys and values differ in number");
  if (!finite(channel.times) || !finiteStream(channel.values) || !finite(channel.weights))
    return fault("animation", index, "a key is not a finite number");
  for (std::size_t i = 1; i < channel.times.size(); ++i)
    if (channel.times[i] <= channel.times[i - 1])
      return fault("animation", index, "times do not rise");
  return {};
}

Status checkSkin(const Skin& skin, std::size_t index, std::size_t nodeCount) {
  for (const std::uint32_t joint : skin.joints)
    if (joint >= nodeCount) return fault("skin", index, "a joint is out of range");
  if (skin.jointFromMesh.size() != skin.joints.size() || !finiteStream(skin.jointFromMesh))
    return fault("skin", index, "its matrices are not one a joint, or not finite");
  return {};
}

// Its skin has all joints that its mesh follows.
bool goodSkin(const Scene& scene, const Object& object) {
  if (object.morphNode != kNone && object.morphNode >= scene.nodes.size()) return false;
  if (object.skin == kNone) return true;
  if (object.skin >= scene.skins.size()) return false;
  const auto& joints = scene.meshes[object.mesh].influences.joints;
  const auto highest = std::max_element(joints.begin(), joints.end());
  return highest == joints.end() || *highest < scene.skins[object.skin].joints.size();
}

Status checkBake(const BakeHints& bake) {
  const AreaLightRule area = bake.area.value_or(AreaLightRule{});
  const float tolerance = bake.patchTolerance.value_or(0.f);
  const int size = bake.mapSize.value_or(16);
  const bool good = finite(vec3(area.cut, area.attenuation, area.intensity)) && area.cut > 0.f &&
                    area.attenuation > 0.f && area.intensity >= 0.f && std::isfinite(tolerance) &&
                    tolerance >= 0.f && size >= 16 && size <= 16384;
  return good ? Status() : error(ErrorKind::Input, "a bake hint is out of range");
}

Status checkLight(const Light& light, std::size_t index, std::size_t nodeCount) {
  const float numbers[] = {
      light.intensity, light.ambientIntensity, light.range,     light.radius,
      light.angle,     light.innerCone,        light.outerCone, light.exponent};
  if (light.node != kNone && light.node >= nodeCount)
    return fault("light", index, "its node is out of range");
  if (!finite(numbers) || !finite(light.color) || !finite(light.attenuation))
    return fault("light", index, "a value is not a finite number");
  return {};
}

}  // namespace

Status checkScene(const Scene& scene, std::size_t textureCount) {
  for (std::size_t i = 0; i < scene.meshes.size(); ++i)
    LUCERNA_TRY_VOID(checkMesh(scene.meshes[i], i));
  for (std::size_t i = 0; i < scene.materials.size(); ++i)
    LUCERNA_TRY_VOID(checkMaterial(scene.materials[i], i, textureCount));
  for (std::size_t i = 0; i < scene.nodes.size(); ++i)
    LUCERNA_TRY_VOID(checkNode(scene.nodes[i], i));
  for (std::size_t i = 0; i < scene.skins.size(); ++i)
    LUCERNA_TRY_VOID(checkSkin(scene.skins[i], i, scene.nodes.size()));
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const Object& object = scene.objects[i];
    if (object.node >= scene.nodes.size() || object.mesh >= scene.meshes.size() ||
        (object.material != kNone && object.material >= scene.materials.size()))
      return fault("object", i, "its node, mesh or material is out of range");
    if (!goodSkin(scene, object)) return fault("object", i, "its skin or its joints do not exist");
  }
  for (std::size_t i = 0; i < scene.lights.size(); ++i)
    LUCERNA_TRY_VOID(checkLight(scene.lights[i], i, scene.nodes.size()));
  for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
    const Camera& camera = scene.cameras[i];
    if (camera.node >= scene.nodes.size()) return fault("camera", i, "its node is out of range");
    if (!std::isfinite(camera.fovY) || !std::isfinite(camera.aspect) ||
        !std::isfinite(camera.height))
      return fault("camera", i, "a value is not a finite number");
  }
  for (std::size_t i = 0; i < scene.animations.size(); ++i)
    for (const AnimationChannel& channel : scene.animations[i].channels)
      LUCERNA_TRY_VOID(checkChannel(channel, i, scene.nodes.size()));
  if (!finite(scene.ambient)) return error(ErrorKind::Input, "the ambient light is not finite");
  return checkBake(scene.bake);
}

}  // namespace lucerna::scene
