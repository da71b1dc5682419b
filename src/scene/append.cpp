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
}

}  // namespace

void append(Scene& scene, Scene part, const Node& place) {
  const bool first = scene.nodes.empty();
  const std::uint32_t root = addNode(scene, place);
  const std::size_t nodes = scene.nodes.size();
  for (Node& node : part.nodes) {
    if (node.parent == kNone)
      node.parent = root;
    else
      shift(node.parent, nodes);
  }
  for (Material& m : part.materials)
    for (TextureSlot* slot : {&m.albedoTexture, &m.emissiveTexture, &m.normalTexture,
                              &m.metallicRoughnessTexture, &m.occlusionTexture})
      if (slot->used()) shift(slot->texture, scene.textures.size());
  for (Object& object : part.objects) {
    shift(object.node, nodes);
    shift(object.mesh, scene.meshes.size());
    shift(object.material, scene.materials.size());
  }
  for (Light& light : part.lights) {
    if (light.node == kNone)
      light.node = root;
    else
      shift(light.node, nodes);
  }
  for (Camera& camera : part.cameras) {
    if (camera.node == kNone)
      camera.node = root;
    else
      shift(camera.node, nodes);
  }
  if (first) {
    shift(part.background.texture, scene.textures.size());
    for (std::uint32_t& face : part.background.faces) shift(face, scene.textures.size());
    scene.background = part.background;
    scene.exposure = part.exposure;
  }
  for (Animation& animation : part.animations)
    for (AnimationChannel& channel : animation.channels) shift(channel.node, nodes);

  move(scene.nodes, part.nodes);
  move(scene.meshes, part.meshes);
  move(scene.materials, part.materials);
  move(scene.textures, part.textures);
  move(scene.objects, part.objects);
  move(scene.lights, part.lights);
  move(scene.cameras, part.cameras);
  move(scene.animations, part.animations);
  move(scene.warnings, part.warnings);
  scene.ambient += part.ambient;
}

}  // namespace lucerna::scene
