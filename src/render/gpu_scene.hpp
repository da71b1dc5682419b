// The resource "scene": the scene's copy on the GPU beside the scene itself.
//
// All meshes share one vertex and one index buffer; objects' matrices are in the storage block
// `ObjectBlock`, a batch's material in the uniform block `MaterialBlock` (render/scene.glsl). What
// reaches the vertex shader is where an object stands in the list that is drawn: the instanced
// attribute `listIndex` counts up from baseInstance, and the list's `DrawOrderBlock` names the
// object. So objects that share a mesh and follow each other in a list are one instanced draw.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gpu/device.hpp"
#include "scene/bvh.hpp"
#include "scene/scene.hpp"

namespace lucerna::render {

// What changed since the last frame; passes with caches read it.
struct SceneChanges {
  bool everything = true;  // a new scene
  std::vector<std::uint32_t> movedObjects;
  bool lights = false, materials = false;
};

struct MeshRange {
  gpu::Topology topology = gpu::Topology::Triangles;
  std::uint32_t firstIndex = 0, indexCount = 0;
  std::int32_t baseVertex = 0;
  std::uint32_t version = 0;  // Mesh::version of the vertices there
};

struct GpuScene {
  static constexpr const char* kPortName = "Scene";
  const scene::Scene* scene = nullptr;
  SceneChanges changes;
  // Another one whenever objects have got other shapes or places, and in each scene: what was made
  // from them holds as long as it stays.
  std::uint64_t geometryRevision = 0;
  scene::Bvh bvh;                 // over the objects' boxes; refitted when objects move
  std::vector<MeshRange> meshes;  // as Scene::meshes
  gpu::Buffer vertices, indices;
  // Mesh::lightmap of all vertices, -1 for the map of those without; none if no mesh has any.
  gpu::Buffer lightmapCoords;
  gpu::Buffer listIndices;  // 0, 1, 2, ...; one an object, and enough for lists of several views
  std::size_t longestList() const { return listIndices.bytes() / sizeof(std::uint32_t); }
  gpu::VertexInput input;          // location 7 only with lightmapCoords
  gpu::Buffer objects, materials;  // ObjectBlock, MaterialBlock
  // As Scene::textures, each sRGB or linear as used; empty if nothing uses it. GL's cube maps are
  // left-handed: look one up at (x, y, -z).
  std::vector<gpu::Texture> textures;
  // Data copies of the textures that are used both as data and as colour.
  std::vector<gpu::Texture> linearTextures;
  std::vector<gpu::Sampler> samplers;  // as Scene::textures
  gpu::Texture white, whiteCube;       // for unused slots
  std::vector<bool> mirrored;          // per object: its matrix flips orientation
};

// Uploads everything. The scene must outlive it.
void upload(gpu::Device& device, GpuScene& gpuScene, const scene::Scene& scene);
// After animate(): object matrices, vertices of meshes that bent, boxes and BVH. Adds to
// changes.movedObjects; who runs a frame clears the changes after it.
void updateMoved(gpu::Device& device, GpuScene& gpuScene, std::span<const std::uint32_t> moved);

}  // namespace lucerna::render
