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

// A slot that may hold a flat picture or a cube map; the sampler of the other kind reads white.
void bindSlot(gpu::Rendering& rendering, const GpuScene& gpuScene, const char* name,
              const char* cubeName, const scene::TextureSlot& slot) {
  const bool cube = slot.used() && gpuScene.scene->textures[slot.texture].isCube();
  bindSlot(rendering, gpuScene, name, cube ? scene::TextureSlot{} : slot, false);
  if (cube)
    bindSlot(rendering, gpuScene, cubeName, slot, false);
  else
    rendering.texture(cubeName, gpuScene.whiteCube, gpu::kNearest);
}

void bindTextures(gpu::Rendering& rendering, const GpuScene& gpuScene,
                  const scene::Material& material) {
  // First: a name that is taken stays the material's.
  for (const scene::CustomShader::Picture& picture : material.shader.textures)
    bindSlot(rendering, gpuScene, picture.name.c_str(), {.texture = picture.texture}, picture.data);
  bindSlot(rendering, gpuScene, "albedoTexture", "albedoCube", material.albedoTexture);
  bindSlot(rendering, gpuScene, "emissiveTexture", "emissiveCube", material.emissiveTexture);
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
  std::uint32_t lastMesh = scene::kNone;
  for (std::uint32_t at = 0; at < list.objects.size(); ++at) {
    const std::uint32_t index = list.objects[at];
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
}

void drawList(gpu::Rendering& rendering, const GpuScene& gpuScene, const DrawList& list,
              gpu::RenderState state, const ProgramOf& programOf) {
  const bool cullBackFaces = state.cull == gpu::Cull::Back;
  if (list.batches.empty()) return;
  rendering.buffer("ObjectBlock", gpuScene.objects);
  rendering.buffer("DrawOrderBlock", list.order);
  for (const DrawBatch& batch : list.batches) {
    const scene::Material& material = gpuScene.scene->materials[batch.material];
    const gpu::Program* program = programOf(material);
    if (!program) continue;
    state.cull = cullBackFaces && !material.doubleSided ? gpu::Cull::Back : gpu::Cull::None;
    state.frontIsClockwise = batch.mirrored;
    state.topology = batch.topology;
    rendering.use(*program, state);
    rendering.buffer("MaterialBlock", gpuScene.materials,
                     batch.material * sizeof(blocks::MaterialValues),
                     sizeof(blocks::MaterialValues));
    bindTextures(rendering, gpuScene, material);
    rendering.multiDraw(gpuScene.input, list.commands, batch.firstCommand, batch.commandCount,
                        batch.primitives);
  }
}

}  // namespace lucerna::render
