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

}  // namespace

void drawList(gpu::Rendering& rendering, const GpuScene& gpuScene, const DrawList& list,
              gpu::RenderState state, const ProgramOf& programOf) {
  const bool cullBackFaces = state.cull == gpu::Cull::Back;
  state.clipDistances = list.clipped ? 1 : 0;
  if (list.batches.empty()) return;
  rendering.buffer("ObjectBlock", gpuScene.objects);
  rendering.buffer("DrawOrderBlock", list.order);
  if (!list.views.empty()) rendering.buffer("DrawViewBlock", list.viewOrder);
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
