#include "passes/shadow_mask/shadow_mask.hpp"

namespace lucerna::passes {

using gpu::Format;

void ShadowMask::describe(graph::PassInfo<Params, Ports>& d) {
  d.pass("ShadowMask", "Finds for each pixel the layers whose light is blocked, a bit for each.");
  d.param("values", &Params::values)
      .choices({"bits", "exponential"})
      .rebuilds(graph::Rebuild::Ports)
      .help(
          "bits: a pixel is blocked or not; exponential: a byte for each layer too, exp(-falloff "
          "(receiver - blocker)) of distances from the light, so that what is hardly behind "
          "itself is hardly dark. Bits are then set where that is below one half.");
  d.param("falloff", &Params::falloff)
      .range(0.1, 1000)
      .unit("1/m")
      .help(
          "exponential: how fast light goes out behind a blocker; half of it 0.7 / falloff m "
          "behind, all that bytes show 5.5 / falloff m.");
  d.param("variant", &Params::variant)
      .choices({"mended", "published"})
      .help(
          "published, of bits: as system C unpacks them, those of each four layers through a byte "
          "of a texture, from which those of some patterns come back wrong.");
  describeLayerLookup(d);
  d.write("shadowMask", &Ports::shadowMask)
      .texture(Format::R32Uint)
      .sizeOf("depth")
      .whenDisabled(vec4(0.f))
      .help("Bit l: the light of layer l that reaches this pixel is blocked.");
  if (d.values().values == Values::Exponential)
    d.write("shadowValues", &Ports::shadowValues)
        .help("Bytes of each layer; of no layers without maps or layers.");
}

const gpu::Program& ShadowMask::programOf(const Params& params, const Ports& ports) {
  gpu::ProgramDesc desc{.vertex = "gpu/fullscreen.vert",
                        .fragment = "passes/shadow_mask/shadow_mask.frag"};
  if (ports.tiled()) desc.defines["TILE_LIGHTS"] = "1";
  if (params.values == Values::Exponential) {
    desc.fragment = "passes/shadow_mask/shadow_values.frag";
    desc.defines["ARRAY_LAYERS"] = std::to_string(render::arrayLayersOf(ports.layers()));
  } else {
    desc.defines["PLANE_COMPARISON"] = "1";
    if (params.variant == render::LayeredVariant::Published) desc.defines["PUBLISHED"] = "1";
  }
  gpu::ProgramPtr& program = programs_[desc];
  if (!program) program = device_.program(desc);
  return *program;
}

void ShadowMask::drawBits(const Params& params, const Ports& ports) {
  gpu::Rendering rendering =
      device_.render({.colors = {{ports.shadowMask.get(), gpu::Load::Clear, vec4(0.f)}},
                      .depth = {ports.depth.get()}});
  if (ports.layers() == 0) return;
  const gpu::Program& program = programOf(params, ports);
  rendering.use(program,
                {.depthTest = true, .depthCompare = gpu::Compare::Less, .cull = gpu::Cull::None});
  bindLayerLookup(rendering, program, params, ports, render::kPlaneReach);
  rendering.fullscreen();
}

void ShadowMask::drawValues(const Params& params, const Ports& ports) {
  gpu::Rendering rendering = device_.render(render::targetsOf(ports.shadowValues->bytes));
  const gpu::Program& program = programOf(params, ports);
  rendering.use(program, {.cull = gpu::Cull::None});
  bindLayerLookup(rendering, program, params, ports, render::kNearestReach);
  program.set("falloff", params.falloff);
  rendering.fullscreen();
}

// Apart from the values, as those of 32 layers take all targets.
void ShadowMask::drawBitsOfValues(const Ports& ports) {
  gpu::Rendering rendering =
      device_.render({.colors = {{ports.shadowMask.get(), gpu::Load::Discard}}});
  rendering.use(*bitsOfValues_, {.cull = gpu::Cull::None});
  rendering.texture("shadowValues", ports.shadowValues->bytes, gpu::kNearest);
  bitsOfValues_->set("arrayLayers", ports.shadowValues->bytes.desc().layers);
  rendering.fullscreen();
}

void ShadowMask::execute(graph::PassContext&, const Params& params, const Ports& ports) {
  if (params.values == Values::Bits) return drawBits(params, ports);
  render::ShadowValues& out = *ports.shadowValues;
  out.layers = ports.layers();
  render::fitLayers(device_, out.bytes, Format::R32Uint, *ports.depth, 1, out.layers,
                    "shadow values");
  if (out.layers == 0) return drawBits(params, ports);
  drawValues(params, ports);
  drawBitsOfValues(ports);
}

}  // namespace lucerna::passes
