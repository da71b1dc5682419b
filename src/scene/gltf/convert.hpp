// The parts of a checked glTF document become the parts of a Scene. Each function throws Fault.
#pragma once

#include <vector>

#include "scene/gltf/accessors.hpp"
#include "scene/gltf/document.hpp"
#include "scene/scene.hpp"

namespace lucerna::scene::gltf {

// What one glTF primitive became: a mesh of the scene, and its glTF material or kNone.
struct Part {
  std::uint32_t mesh = kNone, material = kNone;
};

struct Context {
  Document& document;
  std::vector<Accessor> accessors;
  Scene& scene;
  std::vector<std::vector<Part>> parts;  // by glTF mesh; primitives that cannot be drawn are absent
  std::vector<std::uint32_t> sceneNodes;  // by glTF node; kNone outside the drawn scene
  std::uint32_t defaultMaterial = kNone;  // made when the first primitive needs it
};

// Scene::meshes and Context::parts: triangle lists of all primitives; equal primitives share a
// mesh.
void readMeshes(Context& context);
// Scene::materials (one for each glTF material, at the same index) and Scene::textures.
void readMaterials(Context& context);
// Scene::nodes (of the file's default scene, parents first), objects, cameras and lights.
void readNodes(Context& context);
// Scene::animations: translation, rotation and scale of nodes.
void readAnimations(Context& context);

}  // namespace lucerna::scene::gltf
