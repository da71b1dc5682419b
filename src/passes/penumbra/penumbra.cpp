#include "passes/penumbra/penumbra.hpp"

namespace lucerna::passes {

using gpu::Format;

void Penumbra::describe(graph::PassInfo<Params, Ports>& d) {
  d.pass("Penumbra", "Finds how wide penumbrae are, for each layer of screen-space shadows.");
  d.param("search", &Params::search)
      .range(3, 47)
      .help("Depths along each side of a light's map that are searched for blockers, odd.");
  d.param("bias", &Params::bias)
      .range(0, 100)
      .unit("m")
      .help("How far a point is moved towards the light before it is compared.");
  d.param("normalBias", &Params::normalBias)
      .range(0, 16)
      .help("How far a point is moved off its surface before it is compared: see TiledLighting.");
  d.read("view", &Ports::view).help("The view that the G-buffer was drawn from.");
  d.read("lights", &Ports::lights).help("Lights that are on.");
  d.read("tileLights", &Ports::tileLights)
      .optional()
      .help("Which lights may reach a pixel; without it each pixel tries them all.");
  d.read("shadowMaps", &Ports::shadowMaps).optional().help("What each light sees.");
  d.read("shadowLayers", &Ports::shadowLayers).optional().help("The layer of each light.");
  d.read("depth", &Ports::depth).texture(Format::Depth32F).halo(1).help("Reversed depth.");
  d.read("normal", &Ports::normal)
      .texture(Format::Rg16Unorm)
      .sameSizeAs("depth")
      .help("View-space normal, octahedral.");
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
  out.layers = ports.shadowMaps && ports.shadowLayers ? ports.shadowLayers->count : 0;
  render::fitLayers(context.device, out.widths, Format::Rgba16Float, *ports.depth, out.layers,
                    "penumbrae");
  if (out.layers == 0) return;
  gpu::Rendering rendering = context.device.render(render::targetsOf(out.widths));
  const gpu::Program& program = programOf(ports, render::arrayLayersOf(out.layers));
  rendering.use(program, {.cull = gpu::Cull::None});
  rendering.buffer("ViewBlock", ports.view->block);
  rendering.buffer("LightBlock", ports.lights->block);
  if (ports.tileLights) rendering.buffer("TileLightBlock", ports.tileLights->block);
  rendering.buffer("ShadowLayerBlock", ports.shadowLayers->block);
  render::bindShadowMaps(rendering, *ports.shadowMaps, false);
  rendering.texture("depth", *ports.depth, gpu::kNearest);
  rendering.texture("normal", *ports.normal, gpu::kNearest);
  program.set("shadowReach", 0.5f);
  program.set("shadowSearchRadius", params.search / 2);
  program.set("shadowBias", params.bias);
  program.set("shadowNormalBias", params.normalBias);
  rendering.fullscreen();
}

}  // namespace lucerna::passes
