#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>

#include "core/parallel.hpp"
#include "render/upload.hpp"

namespace lucerna::render {
namespace {

constexpr std::size_t kListOfSeveralViews = 65536;  // objects of all of them

using Snorm16x4 = std::array<std::int16_t, 4>;

struct Vertex {
  vec3 position{0.f};
  Snorm16x4 normal{};
  Snorm16x4 tangent{};
  vec2 texCoord0{0.f}, texCoord1{0.f};
  u8vec4 color{255};
};
static_assert(sizeof(Vertex) == 48);

std::int16_t snorm16(float value) {
  const float scaled = std::clamp(value, -1.f, 1.f) * 32767.f;
  return static_cast<std::int16_t>(scaled < 0.f ? scaled - 0.5f : scaled + 0.5f);
}

Snorm16x4 packed(vec3 v, float w) {
  return {snorm16(v.x), snorm16(v.y), snorm16(v.z), snorm16(w)};
}

Vertex vertexOf(const scene::Mesh& mesh, std::size_t i) {
  Vertex vertex{.position = mesh.positions[i]};
  if (!mesh.normals.empty()) vertex.normal = packed(mesh.normals[i], 0.f);
  if (!mesh.tangents.empty()) {
    const vec4 tangent = mesh.tangents[i];
    vertex.tangent = packed(vec3(tangent), tangent.w < 0.f ? -1.f : 1.f);
  }
  if (!mesh.texCoords[0].empty()) vertex.texCoord0 = mesh.texCoords[0][i];
  if (!mesh.texCoords[1].empty()) vertex.texCoord1 = mesh.texCoords[1][i];
  if (!mesh.colors.empty()) vertex.color = mesh.colors[i];
  return vertex;
}

gpu::Topology topologyOf(const scene::Mesh& mesh) {
  if (!mesh.lines.empty()) return gpu::Topology::Lines;
  return mesh.points.empty() ? gpu::Topology::Triangles : gpu::Topology::Points;
}

void writeVertices(const scene::Mesh& mesh, Vertex* to) {
  parallelFor(mesh.positions.size(), 16384, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) to[i] = vertexOf(mesh, i);
  });
}

// Beside the other vertices, so that scenes without baked light and passes that do not ask for it
// read nothing.
void uploadLightmapCoords(gpu::Device& device, GpuScene& gpuScene, std::size_t vertexCount) {
  const std::vector<scene::Mesh>& meshes = gpuScene.scene->meshes;
  gpuScene.lightmapCoords = {};
  const auto lit = [](const scene::Mesh& mesh) { return !mesh.lightmap.empty(); };
  if (std::ranges::none_of(meshes, lit)) return;
  std::vector<vec3> coords(vertexCount, vec3(0.f, 0.f, -1.f));
  for (std::size_t m = 0; m < meshes.size(); ++m)
    std::ranges::copy(meshes[m].lightmap, coords.begin() + gpuScene.meshes[m].baseVertex);
  gpuScene.lightmapCoords =
      device.createBuffer(std::as_bytes(std::span(coords)), "lightmap coordinates");
}

void makeInput(gpu::Device& device, GpuScene& gpuScene) {
  using Type = gpu::VertexAttribute::Type;
  const auto at = [](std::size_t offset) { return static_cast<std::uint32_t>(offset); };
  gpu::VertexInputDesc desc{
      .buffers = {{.buffer = &gpuScene.vertices, .stride = sizeof(Vertex), .divisor = 0},
                  {.buffer = &gpuScene.listIndices, .stride = 4, .divisor = 1}},
      .attributes = {{0, 0, 3, Type::Float, at(offsetof(Vertex, position))},
                     {1, 0, 3, Type::Snorm16, at(offsetof(Vertex, normal))},
                     {2, 0, 4, Type::Snorm16, at(offsetof(Vertex, tangent))},
                     {3, 0, 2, Type::Float, at(offsetof(Vertex, texCoord0))},
                     {4, 0, 2, Type::Float, at(offsetof(Vertex, texCoord1))},
                     {5, 0, 4, Type::Unorm8, at(offsetof(Vertex, color))},
                     {6, 1, 1, Type::Uint32, 0}},
      .indices = &gpuScene.indices};
  if (gpuScene.lightmapCoords) {
    desc.buffers.push_back(
        {.buffer = &gpuScene.lightmapCoords, .stride = sizeof(vec3), .divisor = 0});
    desc.attributes.push_back({7, 2, 3, Type::Float, 0});
  }
  gpuScene.input = device.createVertexInput(desc, "scene");
}

}  // namespace

void uploadGeometry(gpu::Device& device, GpuScene& gpuScene) {
  const scene::Scene& scene = *gpuScene.scene;
  std::size_t vertexCount = 0;
  std::size_t indexCount = 0;
  gpuScene.meshes.clear();
  for (const scene::Mesh& mesh : scene.meshes) {
    gpuScene.meshes.push_back({.topology = topologyOf(mesh),
                               .firstIndex = static_cast<std::uint32_t>(indexCount),
                               .indexCount = static_cast<std::uint32_t>(mesh.elements().size()),
                               .baseVertex = static_cast<std::int32_t>(vertexCount),
                               .version = mesh.version});
    vertexCount += mesh.positions.size();
    indexCount += mesh.elements().size();
  }

  std::vector<Vertex> vertices(std::max<std::size_t>(vertexCount, 1));
  std::vector<std::uint32_t> indices(std::max<std::size_t>(indexCount, 1));
  for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
    const scene::Mesh& mesh = scene.meshes[m];
    writeVertices(mesh, vertices.data() + gpuScene.meshes[m].baseVertex);
    std::ranges::copy(mesh.elements(), indices.begin() + gpuScene.meshes[m].firstIndex);
  }
  std::vector<std::uint32_t> listIndices(std::max(scene.objects.size(), kListOfSeveralViews));
  std::iota(listIndices.begin(), listIndices.end(), 0u);

  gpuScene.vertices = device.createBuffer(std::as_bytes(std::span(vertices)), "vertices");
  gpuScene.indices = device.createBuffer(std::as_bytes(std::span(indices)), "indices");
  gpuScene.listIndices = device.createBuffer(std::as_bytes(std::span(listIndices)), "list indices");
  uploadLightmapCoords(device, gpuScene, vertexCount);
  makeInput(device, gpuScene);
}

void uploadBentMeshes(gpu::Device& device, GpuScene& gpuScene) {
  std::vector<Vertex> vertices;
  for (const scene::Deformation& deformation : gpuScene.scene->deformations) {
    const scene::Mesh& mesh = gpuScene.scene->meshes[deformation.mesh];
    MeshRange& range = gpuScene.meshes[deformation.mesh];
    if (range.version == mesh.version) continue;
    range.version = mesh.version;
    vertices.resize(mesh.positions.size());
    writeVertices(mesh, vertices.data());
    device.update(gpuScene.vertices, std::as_bytes(std::span(vertices)),
                  static_cast<std::size_t>(range.baseVertex) * sizeof(Vertex));
  }
}

}  // namespace lucerna::render
