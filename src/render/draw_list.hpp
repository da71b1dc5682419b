// What Cull makes and drawing passes read: objects to draw, sorted, grouped into batches that share
// a material, with their indirect draw commands on the GPU.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "render/gpu_scene.hpp"

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
  std::vector<DrawBatch> batches;
  gpu::Buffer commands;  // gpu::IndexedDrawCommand, one an object
};

struct DrawLists {
  static constexpr const char* kPortName = "DrawLists";
  DrawList opaque;                        // by material, then mesh
  DrawList alphaTested;                   // likewise
  DrawList transparent;                   // back to front by the box's centre, ties by object index
  DrawList mirrors;                       // filled once materials can be mirrors
  std::uint32_t tested = 0, visible = 0;  // objects of the scene; of them in the lists

  std::array<DrawList*, 4> all() { return {&opaque, &alphaTested, &transparent, &mirrors}; }
};

// Makes batches and commands from list.objects, keeping their order.
void finishList(gpu::Device& device, const GpuScene& gpuScene, DrawList& list);

// Draws a list with one program: binds blocks, per batch the material's textures and cull side.
// `state` gives everything but frontIsClockwise; its cull: Back culls the back faces of materials
// that are not doubleSided, None culls nothing. view: the ViewBlock to draw from. Further blocks
// that the program reads (lights) are bound by the caller before, after use() of the same program.
void drawList(gpu::Rendering& rendering, const GpuScene& gpuScene, const DrawList& list,
              const gpu::Program& program, gpu::RenderState state, const gpu::Buffer& view);

}  // namespace lucerna::render
