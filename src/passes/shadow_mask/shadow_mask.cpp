#include "passes/shadow_mask/shadow_mask.hpp"

namespace lucerna::passes {

using gpu::Format;

void ShadowMask::describe(graph::PassInfo<Params, Ports>& d) {
  d.pass("ShadowMask", "Finds for each pixel the layers whose light is blocked, a bit for each.");
  describeLayerLookup(d);
  d.write("shadowMask", &Ports::shadowMask)
      .texture(Format::R32Uint)
      .sizeOf("depth")
      .whenDisabled(vec4(0.f))
      .help("Bit l: the light of layer l that reaches this pixel is blocked.");
}

ShadowMask::ShadowMask(gpu::Device& device) {
  gpu::ProgramDesc desc{.vertex = "gpu/fullscreen.vert",
                        .fragment = "passes/shadow_mask/shadow_mask.frag"};
  ofAllLights_ = device.program(desc);
  desc.defines["TILE_LIGHTS"] = "1";
  ofTiles_ = device.program(desc);
}

void ShadowMask::execute(graph::PassContext& context, const Params& params, const Ports& ports) {
  gpu::Rendering rendering =
      context.device.render({.colors = {{ports.shadowMask.get(), gpu::Load::Clear, vec4(0.f)}},
                             .depth = {ports.depth.get()}});
  if (ports.layers() == 0) return;
  const gpu::Program& program = ports.tileLights ? *ofTiles_ : *ofAllLights_;
  rendering.use(program,
                {.depthTest = true, .depthCompare = gpu::Compare::Less, .cull = gpu::Cull::None});
  bindLayerLookup(rendering, program, params, ports);
  rendering.fullscreen();
}

}  // namespace lucerna::passes
