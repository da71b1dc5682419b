#include "passes/shadow_mask/shadow_mask.hpp"

namespace lucerna::passes {

using gpu::Format;

void ShadowMask::describe(graph::PassInfo<Params, Ports>& d) {
  d.pass("ShadowMask", "Finds for each pixel the layers whose light is blocked, a bit for each.");
  d.param("variant", &Params::variant)
      .choices({"mended", "published"})
      .help(
          "published: as system C unpacks them, the bits of each four layers through a byte of a "
          "texture, from which those of some patterns come back wrong.");
  describeLayerLookup(d);
  d.write("shadowMask", &Ports::shadowMask)
      .texture(Format::R32Uint)
      .sizeOf("depth")
      .whenDisabled(vec4(0.f))
      .help("Bit l: the light of layer l that reaches this pixel is blocked.");
}

const gpu::Program& ShadowMask::programOf(const Params& params, const Ports& ports) {
  gpu::ProgramDesc desc{.vertex = "gpu/fullscreen.vert",
                        .fragment = "passes/shadow_mask/shadow_mask.frag",
                        .defines = {{"PLANE_COMPARISON", "1"}}};
  if (ports.tiled()) desc.defines["TILE_LIGHTS"] = "1";
  if (params.variant == render::LayeredVariant::Published) desc.defines["PUBLISHED"] = "1";
  gpu::ProgramPtr& program = programs_[desc];
  if (!program) program = device_.program(desc);
  return *program;
}

void ShadowMask::execute(graph::PassContext& context, const Params& params, const Ports& ports) {
  gpu::Rendering rendering =
      context.device.render({.colors = {{ports.shadowMask.get(), gpu::Load::Clear, vec4(0.f)}},
                             .depth = {ports.depth.get()}});
  if (ports.layers() == 0) return;
  const gpu::Program& program = programOf(params, ports);
  rendering.use(program,
                {.depthTest = true, .depthCompare = gpu::Compare::Less, .cull = gpu::Cull::None});
  bindLayerLookup(rendering, program, params, ports, render::kPlaneReach);
  rendering.fullscreen();
}

}  // namespace lucerna::passes
