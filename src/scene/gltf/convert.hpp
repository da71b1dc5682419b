// The parts of a checked glTF document become the parts of a Scene. Each function throws Fault.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "scene/gltf/accessors.hpp"
#include "scene/gltf/document.hpp"
#include "scene/scene.hpp"

namespace lucerna::scene::gltf {

// What one glTF primitive became: a mesh of the scene, and its glTF material or kNone.
struct Part {
  std::uint32_t mesh = kNone, material = kNone;
};

// What one glTF mesh became; primitives that cannot be drawn are absent.
struct MeshParts {
  std::vector<Part> parts;
  std::size_t targets = 0;     // morph targets of each part
  std::vector<float> weights;  // of the targets, where a node states none; empty: 0
};

// What a packed primitive (KHR_draco_mesh_compression) has instead of the accessors it names.
struct UnpackedPrimitive {
  Accessor indices;
  std::map<std::string, Accessor> attributes;
};

// A glTF node with a mesh and a skin. Its joints may stand anywhere in the hierarchy, so its
// objects are made when all nodes are there.
struct SkinnedNode {
  Place place;
  std::uint32_t node = kNone, mesh = kNone, skin = kNone;  // of the scene; of the file; of the file
};

struct Context {
  Document& document;
  std::vector<Accessor> accessors;
  Scene& scene;
  std::map<std::string, std::optional<UnpackedPrimitive>> unpacked;  // by primitiveKey()
  std::vector<MeshParts> meshes;                                     // by glTF mesh
  std::vector<std::uint32_t> sceneNodes;  // by glTF node; kNone outside the drawn scene
  std::vector<SkinnedNode> skinnedNodes;
  std::uint32_t defaultMaterial = kNone;  // made when the first primitive needs it
};

// Primitives with the same key have the same vertices and elements.
std::string primitiveKey(const Place& primitive);
// Context::unpacked: all packed primitives.
void unpackPrimitives(Context& context);
// Scene::meshes and Context::meshes: lists of triangles, lines or points of all primitives; equal
// primitives share a mesh.
void readMeshes(Context& context);
// The numbers of "weights": as many as there are targets, or none.
std::vector<float> readMorphWeights(const Place& owner, std::size_t targets);
// Scene::materials (one for each glTF material, at the same index) and Scene::textures.
void readMaterials(Context& context);
// Scene::nodes (of the file's default scene, parents first), objects, cameras and lights.
void readNodes(Context& context);
// An object for each part of a glTF mesh, which `place` asks for, with its weights stated by
// `morphNode` of the scene. Returns the first one's index.
std::size_t addObjects(Context& context, const Place& place, std::uint32_t gltfMesh,
                       std::uint32_t node, std::uint32_t morphNode);
// Scene::skins, and the objects of Context::skinnedNodes.
void readSkins(Context& context);
// Scene::animations: transforms and morph weights of nodes.
void readAnimations(Context& context);

}  // namespace lucerna::scene::gltf
