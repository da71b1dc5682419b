#include "scene/append.hpp"

#include <iterator>

namespace lucerna::scene {
namespace {

void shift(std::uint32_t& index, std::size_t by) {
  if (index != kNone) index += static_cast<std::uint32_t>(by);
}

template <typename T>
void move(std::vector<T>& to, std::vector<T>& from) {
  to.insert(to.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
  from.clear();
}

// All indices into Scene::meshes and Scene::textures.
void shiftShared(Scene& scene, std::size_t meshes, std::size_t textures) {
  for (Material& m : scene.materials) {
    for (TextureSlot* slot : {&m.albedoTexture, &m.emissiveTexture, &m.normalTexture,
                              &m.metallicRoughnessTexture, &m.occlusionTexture, &m.specularTexture})
      shift(slot->texture, textures);
    for (CustomShader::Picture& picture : m.shader.textures) shift(picture.texture, textures);
  }
  for (Object& object : scene.objects) shift(object.mesh, meshes);
  shift(scene.background.texture, textures);
}

template <typename T>
std::uint64_t bytesOfNamed(const std::vector<T>& list) {
  std::uint64_t bytes = 0;
  for (const T& entry : list) bytes += sizeof(T) + entry.name.size();
  return bytes;
}

}  // namespace

void append(Scene& scene, Scene part, const Node& place, std::optional<std::size_t> materials) {
  const bool first = scene.nodes.empty();
  const std::uint32_t root = addNode(scene, place);
  const std::size_t nodes = scene.nodes.size();
  shiftShared(part, scene.meshes.size(), scene.textures.size());
  const auto below = [&](std::uint32_t& node) {
    if (node == kNone)
      node = root;
    else
      shift(node, nodes);
  };
  for (Node& node : part.nodes) below(node.parent);
  for (Object& object : part.objects) {
    shift(object.node, nodes);
    shift(object.material, materials.value_or(scene.materials.size()));
    shift(object.skin, scene.skins.size());
    shift(object.morphNode, nodes);
  }
  for (Skin& skin : part.skins)
    for (std::uint32_t& joint : skin.joints) shift(joint, nodes);
  for (Light& light : part.lights) below(light.node);
  for (Camera& camera : part.cameras) below(camera.node);
  for (Animation& animation : part.animations)
    for (AnimationChannel& channel : animation.channels) shift(channel.node, nodes);
  if (scene.bake == BakeHints{}) scene.bake = part.bake;
  if (first) {
    scene.background = part.background;
    scene.exposure = part.exposure;
  }

  move(scene.nodes, part.nodes);
  move(scene.meshes, part.meshes);
  if (!materials) move(scene.materials, part.materials);
  move(scene.textures, part.textures);
  move(scene.objects, part.objects);
  move(scene.skins, part.skins);
  move(scene.lights, part.lights);
  move(scene.cameras, part.cameras);
  move(scene.animations, part.animations);
  move(scene.warnings, part.warnings);
  scene.ambient += part.ambient;
}

void moveShared(Scene& scene, std::vector<Mesh>& meshes, std::vector<Texture>& textures) {
  shiftShared(scene, meshes.size(), textures.size());
  move(meshes, scene.meshes);
  move(textures, scene.textures);
}

std::uint64_t bytesOf(const Scene& scene) {
  std::uint64_t bytes = scene.objects.size() * sizeof(Object);
  bytes += bytesOfNamed(scene.nodes) + bytesOfNamed(scene.materials) + bytesOfNamed(scene.lights) +
           bytesOfNamed(scene.cameras) + bytesOfNamed(scene.animations) + bytesOfNamed(scene.skins);
  for (const Node& node : scene.nodes) bytes += node.weights.size() * sizeof(float);
  for (const Skin& skin : scene.skins)
    bytes += skin.joints.size() * (sizeof(std::uint32_t) + sizeof(mat4));
  for (const Animation& animation : scene.animations)
    for (const AnimationChannel& channel : animation.channels)
      bytes += sizeof(AnimationChannel) +
               (channel.times.size() + channel.weights.size()) * sizeof(float) +
               channel.values.size() * sizeof(vec4);
  return bytes;
}

}  // namespace lucerna::scene
