#include "passes/penumbra/penumbra.hpp"

namespace lucerna::passes {

using gpu::Format;

void Penumbra::describe(graph::PassInfo<Params, Ports>& d) {
  d.pass("Penumbra", "Finds how wide penumbrae are, for each layer of screen-space shadows.");
  describeWidths(d);
  d.param("resolution", &Params::resolution)
      .choices({"half", "full"})
      .help("Of the picture: half takes every second pixel along each axis.");
  d.param("variant", &Params::variant)
      .choices({"mended", "published"})
      .help("published: as system C has it, with the light's size, in m, as a factor twice.");
  describeLayerLookup(d);
  describePartlyLit(d);
  if (d.values().method == Method::Minimum) describeNearestBlockers(d);
  d.write("penumbrae", &Ports::penumbrae).help("Widths in m; of no layers without maps or layers.");
}

const gpu::Program& Penumbra::programOf(const Ports& ports) {
  gpu::ProgramDesc desc{
      .vertex = "gpu/fullscreen.vert",
      .fragment = "passes/penumbra/penumbra.frag",
      .defines = {{"ARRAY_LAYERS", std::to_string(render::arrayLayersOf(ports.layers()))}}};
  defineLayerWidths(desc, ports);
  gpu::ProgramPtr& program = programs_[desc];
  if (!program) program = device_.program(desc);
  return *program;
}

void Penumbra::execute(graph::PassContext& context, const Params& params, const Ports& ports) {
  const bool byNearest = params.method == Method::Minimum;
  render::Penumbrae& out = *ports.penumbrae;
  out.layers = byNearest && !ports.nearestBlockers ? 0 : ports.layers();
  out.scale = scaleOf(params.resolution);
  render::fitLayers(context.device, out.widths, Format::Rgba16Float, *ports.depth, out.scale,
                    out.layers, "penumbrae");
  if (out.layers == 0) return;
  gpu::Rendering rendering = context.device.render(render::targetsOf(out.widths));
  const gpu::Program& program = programOf(ports);
  rendering.use(program, {.cull = gpu::Cull::None});
  bindLayerWidths(rendering, program, params, ports, params.variant);
  if (!byNearest) program.set("shadowSearchRadius", params.search / 2);
  program.set("scale", out.scale);
  rendering.fullscreen();
}

}  // namespace lucerna::passes
