// Sorting objects into lists, and lists into draw commands.
#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "render/draw_list.hpp"

namespace lucerna::render {
namespace {

DrawList& listOf(const scene::Material& material, DrawLists& lists) {
  if (isMirror(material)) return lists.mirrors;
  switch (material.alphaMode) {
    case scene::AlphaMode::Opaque:
      return lists.opaque;
    case scene::AlphaMode::Mask:
      return lists.alphaTested;
    case scene::AlphaMode::Blend:
      break;
  }
  return lists.transparent;
}

std::uint32_t cornersOf(gpu::Topology topology) {
  return topology == gpu::Topology::Triangles ? 3 : topology == gpu::Topology::Lines ? 2 : 1;
}

// What is drawn alike.
struct BatchKey {
  std::uint32_t material = scene::kNone;  // none: any that draws depth without a test of alpha
  bool mirrored = false;
  gpu::Topology topology = gpu::Topology::Triangles;
  bool operator==(const BatchKey&) const = default;
};
BatchKey batchKey(const GpuScene& gpuScene, const DrawList& list, std::uint32_t index) {
  const scene::Object& object = gpuScene.scene->objects[index];
  const scene::Material& material = gpuScene.scene->materials[object.material];
  const gpu::Topology topology = gpuScene.meshes[object.mesh].topology;
  if (list.depthOnly && material.alphaMode != scene::AlphaMode::Mask) return {.topology = topology};
  return {.material = object.material,
          .mirrored = !list.depthOnly && gpuScene.mirrored[index] != list.mirrored,
          .topology = topology};
}

}  // namespace

void sortForState(const GpuScene& gpuScene, std::vector<std::uint32_t>& objects) {
  const auto key = [&](std::uint32_t index) {
    const scene::Object& object = gpuScene.scene->objects[index];
    return std::tuple(object.material, static_cast<bool>(gpuScene.mirrored[index]), object.mesh,
                      index);
  };
  std::ranges::sort(objects, {}, key);
}

void sortBackToFront(const GpuScene& gpuScene, const scene::View& view,
                     std::vector<std::uint32_t>& objects) {
  // The eye looks along -z, so the farthest centre has the smallest z.
  const vec4 depthRow(view.viewFromWorld[0].z, view.viewFromWorld[1].z, view.viewFromWorld[2].z,
                      view.viewFromWorld[3].z);
  std::vector<std::pair<float, std::uint32_t>> keyed;
  keyed.reserve(objects.size());
  for (const std::uint32_t index : objects) {
    const vec3 center = gpuScene.scene->objects[index].boundsW.center();
    const float depth = glm::dot(depthRow, vec4(center, 1.f));
    // A box without bounds has no centre: it counts as farthest, for a NaN cannot be sorted.
    keyed.emplace_back(std::isfinite(depth) ? depth : -std::numeric_limits<float>::infinity(),
                       index);
  }
  std::ranges::sort(keyed);
  std::ranges::transform(keyed, objects.begin(), [](const auto& pair) { return pair.second; });
}

void finishList(gpu::Device& device, const GpuScene& gpuScene, DrawList& list) {
  CHECK(list.objects.size() <= gpuScene.longestList() &&
            (list.views.empty() || list.views.size() == list.objects.size()),
        "a list of {} objects and {} views", list.objects.size(), list.views.size());
  list.batches.clear();
  std::vector<gpu::IndexedDrawCommand> commands;
  std::uint32_t lastMesh = scene::kNone;
  BatchKey lastKey;
  for (std::uint32_t at = 0; at < list.objects.size(); ++at) {
    const std::uint32_t index = list.objects[at];
    const scene::Object& object = gpuScene.scene->objects[index];
    const MeshRange& mesh = gpuScene.meshes[object.mesh];
    const BatchKey key = batchKey(gpuScene, list, index);
    if (list.batches.empty() || lastKey != key)
      list.batches.push_back({.material = object.material,
                              .mirrored = gpuScene.mirrored[index] != list.mirrored,
                              .topology = mesh.topology,
                              .firstCommand = static_cast<std::uint32_t>(commands.size())});
    lastKey = key;
    DrawBatch& batch = list.batches.back();
    batch.primitives += mesh.indexCount / cornersOf(mesh.topology);
    if (batch.commandCount > 0 && object.mesh == lastMesh) {
      ++commands.back().instanceCount;
      continue;
    }
    lastMesh = object.mesh;
    ++batch.commandCount;
    commands.push_back({.indexCount = mesh.indexCount,
                        .instanceCount = 1,
                        .firstIndex = mesh.firstIndex,
                        .baseVertex = mesh.baseVertex,
                        .baseInstance = at});
  }
  if (commands.empty()) return;
  device.write(list.commands, std::as_bytes(std::span(commands)), "draw commands");
  device.write(list.order, std::as_bytes(std::span(list.objects)), "DrawOrderBlock");
  if (!list.views.empty())
    device.write(list.viewOrder, std::as_bytes(std::span(list.views)), "DrawViewBlock");
}

void finishList(gpu::Device& device, const GpuScene& gpuScene, const scene::View& view,
                DrawList& list) {
  list.mirrored = view.mirrored();
  list.clipped = view.clipPlaneW.has_value();
  finishList(device, gpuScene, list);
}

void makeLists(gpu::Device& device, const GpuScene& gpuScene, const scene::View& view,
               std::span<const std::uint32_t> visible, bool sort, DrawLists& lists) {
  const scene::Scene& scene = *gpuScene.scene;
  for (DrawList* list : lists.all()) list->objects.clear();
  for (const std::uint32_t index : visible)
    listOf(scene.materials[scene.objects[index].material], lists).objects.push_back(index);
  lists.tested = static_cast<std::uint32_t>(scene.objects.size());
  lists.visible = static_cast<std::uint32_t>(visible.size());
  if (sort)
    for (DrawList* list : {&lists.opaque, &lists.alphaTested, &lists.mirrors})
      sortForState(gpuScene, list->objects);
  sortBackToFront(gpuScene, view, lists.transparent.objects);
  for (DrawList* list : lists.all()) finishList(device, gpuScene, view, *list);
}

}  // namespace lucerna::render
