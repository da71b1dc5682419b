#include "passes/penumbra/penumbra.hpp"

namespace lucerna::passes {

using gpu::Format;

void Penumbra::describe(graph::PassInfo<Params, Ports>& d) {
  d.pass("Penumbra", "Finds how wide penumbrae are, for each layer of screen-space shadows.");
  d.param("search", &Params::search)
      .range(3, 47)
      .help("Depths along each side of a light's map that are searched for blockers, odd.");
  describeLayerLookup(d);
  d.write("penumbrae", &Ports::penumbrae)
      .help("Widths in m at half the size; of no layers without maps or layers.");
}

const gpu::Program& Penumbra::programOf(const Ports& ports, int arrayLayers) {
  gpu::ProgramDesc desc{.vertex = "gpu/fullscreen.vert",
                        .fragment = "passes/penumbra/penumbra.frag",
                        .defines = {{"ARRAY_LAYERS", std::to_string(arrayLayers)}}};
  if (ports.tileLights) desc.defines["TILE_LIGHTS"] = "1";
  gpu::ProgramPtr& program = programs_[desc];
  if (!program) program = device_.program(desc);
  return *program;
}

void Penumbra::execute(graph::PassContext& context, const Params& params, const Ports& ports) {
  render::Penumbrae& out = *ports.penumbrae;
  out.layers = ports.layers();
  render::fitLayers(context.device, out.widths, Format::Rgba16Float, *ports.depth, out.layers,
                    "penumbrae");
  if (out.layers == 0) return;
  gpu::Rendering rendering = context.device.render(render::targetsOf(out.widths));
  const gpu::Program& program = programOf(ports, render::arrayLayersOf(out.layers));
  rendering.use(program, {.cull = gpu::Cull::None});
  bindLayerLookup(rendering, program, params, ports);
  program.set("shadowSearchRadius", params.search / 2);
  rendering.fullscreen();
}

}  // namespace lucerna::passes
