#include "scene/scene.hpp"

#include <algorithm>
#include <cmath>

#include "core/check.hpp"
#include "scene/extent.hpp"

namespace lucerna::scene {

mat4 Node::parentFromNode() const {
  if (matrix) return *matrix;
  mat4 m = glm::mat4_cast(rotation);
  m[0] *= scale.x;
  m[1] *= scale.y;
  m[2] *= scale.z;
  m[3] = vec4(translation, 1.f);
  return m;
}

Aabb Scene::boundsW() const {
  Aabb box;
  for (const Object& object : objects)
    if (withinReach(object.boundsW)) box.grow(object.boundsW);
  return box;
}

std::size_t Scene::triangleCount() const {
  std::size_t count = 0;
  for (const Object& object : objects) count += meshes[object.mesh].triangleCount();
  return count;
}

void updateTransforms(Scene& scene) {
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    Node& node = scene.nodes[i];
    CHECK(node.parent == kNone || node.parent < i, "node {} stands before its parent", i);
    node.worldFromNode = node.parent == kNone
                             ? node.parentFromNode()
                             : scene.nodes[node.parent].worldFromNode * node.parentFromNode();
  }
  updateDeformations(scene);
  for (Object& object : scene.objects)
    object.boundsW =
        transformed(scene.nodes[object.node].worldFromNode, scene.meshes[object.mesh].bounds);
}

std::vector<PlacedLight> placeLights(const Scene& scene) {
  std::vector<PlacedLight> placed;
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    const Light& light = scene.lights[i];
    if (!light.on) continue;
    placed.push_back(
        place(light, light.node == kNone ? mat4(1.f) : scene.nodes[light.node].worldFromNode));
    placed.back().light = static_cast<std::uint32_t>(i);
  }
  return placed;
}

std::uint32_t addNode(Scene& scene, Node node) {
  CHECK(node.parent == kNone || node.parent < scene.nodes.size());
  node.worldFromNode = node.parent == kNone
                           ? node.parentFromNode()
                           : scene.nodes[node.parent].worldFromNode * node.parentFromNode();
  scene.nodes.push_back(std::move(node));
  return static_cast<std::uint32_t>(scene.nodes.size() - 1);
}

std::uint32_t addNode(Scene& scene, std::string name, const mat4& worldFromNode) {
  Node node;
  node.name = std::move(name);
  setLocalTransform(node, worldFromNode);
  return addNode(scene, std::move(node));
}

void setLocalTransform(Node& node, const mat4& parentFromNode) {
  const mat3 linear(parentFromNode);
  vec3 scale(glm::length(linear[0]), glm::length(linear[1]), glm::length(linear[2]));
  if (glm::determinant(linear) < 0.f) scale.x = -scale.x;
  node.translation = vec3(parentFromNode[3]);
  node.matrix.reset();
  if (glm::any(glm::equal(scale, vec3(0.f)))) {
    node.matrix = parentFromNode;
    return;
  }
  const mat3 axes(linear[0] / scale.x, linear[1] / scale.y, linear[2] / scale.z);
  // Axes that are not at right angles mean shear, which a rotation and a scale cannot express.
  const float skew =
      std::max({std::abs(glm::dot(axes[0], axes[1])), std::abs(glm::dot(axes[1], axes[2])),
                std::abs(glm::dot(axes[2], axes[0]))});
  if (skew > 1e-4f) {
    node.matrix = parentFromNode;
    return;
  }
  node.rotation = glm::normalize(glm::quat_cast(axes));
  node.scale = scale;
}

}  // namespace lucerna::scene
