// What Cull makes and drawing passes read: objects to draw, sorted, grouped into batches that share
// a material, with their indirect draw commands on the GPU. Objects of one mesh that follow each
// other are instances of one command.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "render/gpu_scene.hpp"
#include "scene/view.hpp"

namespace lucerna::render {

struct DrawBatch {
  std::uint32_t material = 0;  // index in Scene::materials
  bool mirrored = false;       // front faces are clockwise
  gpu::Topology topology = gpu::Topology::Triangles;
  std::uint32_t firstCommand = 0, commandCount = 0;
  std::uint64_t primitives = 0;
};

struct DrawList {
  std::vector<std::uint32_t> objects;  // in drawing order
  // Of a list that several views share (SHADOW_VIEWS of render/object.vert), that of each object;
  // objects and pairs of them with views are at most GpuScene::longestList(). Else empty.
  std::vector<std::uint32_t> views;
  // What draws the same depth shares a batch: for lists of which only depth is drawn, both sides.
  bool depthOnly = false;
  bool mirrored = false, clipped = false;  // of the view it is for (scene::View)
  std::vector<DrawBatch> batches;
  gpu::Buffer commands;   // gpu::IndexedDrawCommand
  gpu::Buffer order;      // `objects`, as the block DrawOrderBlock (render/object.vert)
  gpu::Buffer viewOrder;  // `views`, as DrawViewBlock
};

struct DrawLists {
  static constexpr const char* kPortName = "DrawLists";
  DrawList opaque;                        // by material, then mesh
  DrawList alphaTested;                   // likewise
  DrawList transparent;                   // back to front by the box's centre, ties by object index
  DrawList mirrors;                       // scene::isMirror(); by material, then mesh
  std::uint32_t tested = 0, visible = 0;  // objects of the scene; of them in the lists

  std::array<DrawList*, 4> all() { return {&opaque, &alphaTested, &transparent, &mirrors}; }
  // What hides what lies behind it.
  std::array<const DrawList*, 3> solid() const { return {&opaque, &alphaTested, &mirrors}; }
};

// Makes batches and commands from list.objects, keeping their order: for all views that neither
// mirror nor clip, or for one that may.
void finishList(gpu::Device& device, const GpuScene& gpuScene, DrawList& list);
void finishList(gpu::Device& device, const GpuScene& gpuScene, const scene::View& view,
                DrawList& list);

// Sorts the objects that a view sees into its lists and finishes them. `sort`: by material;
// without, all but the transparent ones keep their order.
void makeLists(gpu::Device& device, const GpuScene& gpuScene, const scene::View& view,
               std::span<const std::uint32_t> visible, bool sort, DrawLists& lists);

// The lists' orders. By material, orientation, mesh, object, so that state changes least.
void sortForState(const GpuScene& gpuScene, std::vector<std::uint32_t>& objects);
// Farthest box centre first along the view axis, ties by object, so that equal input gives equal
// order.
void sortBackToFront(const GpuScene& gpuScene, const scene::View& view,
                     std::vector<std::uint32_t>& objects);

// Chooses the program for a material and sets its uniforms. Null: batches of it are not drawn.
using ProgramOf = std::function<const gpu::Program*(const scene::Material& material)>;

// Draws a list: binds per batch its material's block and textures and sets the cull side. `state`
// gives everything but frontIsClockwise and clipDistances, which are the list's; its cull: Back
// culls the back faces of materials that are not doubleSided, None culls nothing. The caller has
// bound ViewBlock, the view to draw from (a light's as well as an eye's), and what else the
// programs read. Depth alone: ObjectPrograms of render/depth.frag.
void drawList(gpu::Rendering& rendering, const GpuScene& gpuScene, const DrawList& list,
              gpu::RenderState state, const ProgramOf& programOf);

}  // namespace lucerna::render
