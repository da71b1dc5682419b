#include "render/draw_list.hpp"

#include "render/blocks.hpp"

namespace lucerna::render {
namespace {

const gpu::Texture& textureOf(const GpuScene& gpuScene, const scene::TextureSlot& slot, bool data) {
  if (!slot.used()) return gpuScene.white;
  const gpu::Texture& linear = gpuScene.linearTextures[slot.texture];
  return data && linear ? linear : gpuScene.textures[slot.texture];
}

void bindSlot(gpu::Rendering& rendering, const GpuScene& gpuScene, const char* name,
              const scene::TextureSlot& slot, bool data) {
  const gpu::Sampler sampler = slot.used() ? gpuScene.samplers[slot.texture] : gpu::kNearest;
  rendering.texture(name, textureOf(gpuScene, slot, data), sampler);
}

void bindTextures(gpu::Rendering& rendering, const GpuScene& gpuScene,
                  const scene::Material& material) {
  bindSlot(rendering, gpuScene, "albedoTexture", material.albedoTexture, false);
  bindSlot(rendering, gpuScene, "emissiveTexture", material.emissiveTexture, false);
  bindSlot(rendering, gpuScene, "normalTexture", material.normalTexture, true);
  bindSlot(rendering, gpuScene, "metallicRoughnessTexture", material.metallicRoughnessTexture,
           true);
  bindSlot(rendering, gpuScene, "occlusionTexture", material.occlusionTexture, true);
  bindSlot(rendering, gpuScene, "specularTexture", material.specularTexture, false);
}

std::uint32_t cornersOf(gpu::Topology topology) {
  return topology == gpu::Topology::Triangles ? 3 : topology == gpu::Topology::Lines ? 2 : 1;
}

}  // namespace

void finishList(gpu::Device& device, const GpuScene& gpuScene, DrawList& list) {
  list.batches.clear();
  std::vector<gpu::IndexedDrawCommand> commands;
  commands.reserve(list.objects.size());
  for (const std::uint32_t index : list.objects) {
    const scene::Object& object = gpuScene.scene->objects[index];
    const MeshRange& mesh = gpuScene.meshes[object.mesh];
    const bool mirrored = gpuScene.mirrored[index];
    if (list.batches.empty() || list.batches.back().material != object.material ||
        list.batches.back().mirrored != mirrored || list.batches.back().topology != mesh.topology)
      list.batches.push_back({.material = object.material,
                              .mirrored = mirrored,
                              .topology = mesh.topology,
                              .firstCommand = static_cast<std::uint32_t>(commands.size())});
    DrawBatch& batch = list.batches.back();
    ++batch.commandCount;
    batch.primitives += mesh.indexCount / cornersOf(mesh.topology);
    commands.push_back({.indexCount = mesh.indexCount,
                        .instanceCount = 1,
                        .firstIndex = mesh.firstIndex,
                        .baseVertex = mesh.baseVertex,
                        .baseInstance = index});
  }
  if (!commands.empty())
    device.write(list.commands, std::as_bytes(std::span(commands)), "draw commands");
}

void drawList(gpu::Rendering& rendering, const GpuScene& gpuScene, const DrawList& list,
              const gpu::Program& program, gpu::RenderState state, const gpu::Buffer& view) {
  const bool cullBackFaces = state.cull == gpu::Cull::Back;
  for (const DrawBatch& batch : list.batches) {
    const scene::Material& material = gpuScene.scene->materials[batch.material];
    state.cull = cullBackFaces && !material.doubleSided ? gpu::Cull::Back : gpu::Cull::None;
    state.frontIsClockwise = batch.mirrored;
    state.topology = batch.topology;
    rendering.use(program, state);
    rendering.buffer("ObjectBlock", gpuScene.objects);
    rendering.buffer("MaterialBlock", gpuScene.materials,
                     batch.material * sizeof(blocks::MaterialValues),
                     sizeof(blocks::MaterialValues));
    rendering.buffer("ViewBlock", view);
    bindTextures(rendering, gpuScene, material);
    rendering.multiDraw(gpuScene.input, list.commands, batch.firstCommand, batch.commandCount,
                        batch.primitives);
  }
}

}  // namespace lucerna::render
