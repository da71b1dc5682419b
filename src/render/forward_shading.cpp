#include "render/forward_shading.hpp"

namespace lucerna::render {

ForwardShading::ForwardShading(gpu::Device& device,
                               const std::map<std::string, std::string>& defines)
    : programs_(device, "render/forward.frag", defines), customPrograms_(device, defines) {}

void ForwardShading::draw(gpu::Rendering& rendering, const Inputs& inputs, const DrawList& list,
                          const gpu::RenderState& state) {
  rendering.buffer("ViewBlock", inputs.view.block);
  rendering.buffer("LightBlock", inputs.lights.block);
  if (bakesLight(inputs.scene, inputs.lightmaps)) bindLightmaps(rendering, *inputs.lightmaps);
  drawList(rendering, inputs.scene, list, state,
           [&](const scene::Material& material) { return programOf(inputs, material); });
}

const gpu::Program* ForwardShading::programOf(const Inputs& inputs,
                                              const scene::Material& material) {
  const bool custom = material.shader.used();
  if (inputs.onlyCustom && !custom) return nullptr;
  const bool baked = bakesLight(inputs.scene, inputs.lightmaps);
  const gpu::Program* program =
      custom ? customPrograms_.of(*inputs.scene.scene, material, inputs.time, baked)
             : &programs_.of(material, baked);
  if (program) program->set("ambientScale", inputs.ambient);
  return program;
}

}  // namespace lucerna::render
