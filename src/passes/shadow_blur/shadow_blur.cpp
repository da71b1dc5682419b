#include "passes/shadow_blur/shadow_blur.hpp"

namespace lucerna::passes {

using gpu::Format;

void ShadowBlur::describe(graph::PassInfo<Params, Ports>& d) {
  d.pass("ShadowBlur",
         "Blurs the mask of hard shadows by the width of penumbrae, all layers at once.");
  d.param("penumbrae", &Params::penumbrae)
      .choices({"stored", "sampled"})
      .rebuilds(graph::Rebuild::Ports)
      .help(
          "Where widths come from. stored: from Penumbra; sampled: both axes look them up in "
          "NearestBlockers themselves, as Penumbra does with method=minimum, and no Penumbra is "
          "needed; bias and normalBias count there only.");
  describePenumbraBlur(d);
  d.param("variant", &Params::variant)
      .choices({"mended", "published"})
      .help(
          "published: as system C has it, with circles that shrink at grazing angles in place of "
          "ellipses and with differences of stored depth up to 0.03 in place of edgeStop; "
          "sampled widths are those of Penumbra's published variant.");
  describeLookupBias(d);
  const int halo = render::haloOf(d.values());
  d.read("view", render::lookupPort<Ports>(&Ports::view))
      .help("The view that the G-buffer was drawn from.");
  if (d.values().penumbrae == From::Stored) {
    d.read("penumbrae", &Ports::penumbrae)
        .optional()
        .help("Widths of penumbrae; without it no layer is made.");
  } else {
    describeLookupLights(d);
    describePartlyLit(d);
    describeNearestBlockers(d);
  }
  d.read("shadowMask", &Ports::shadowMask)
      .texture(Format::R32Uint)
      .sameSizeAs("depth")
      .halo(halo)
      .help("Hard shadows.");
  d.read("shadowValues", &Ports::shadowValues)
      .optional()
      .help("Bytes of layers, which are blurred in place of bits.");
  d.read("depth", render::lookupPort<Ports>(&Ports::depth))
      .texture(Format::Depth32F)
      .halo(halo)
      .help("Reversed depth.");
  d.read("normal", render::lookupPort<Ports>(&Ports::normal))
      .texture(Format::Rg16Unorm)
      .sameSizeAs("depth")
      .halo(halo)
      .help("View-space normal, octahedral.");
  d.write("layeredShadows", &Ports::layeredShadows).help("What each layer lets through.");
}

namespace {

bool hasValues(const ShadowBlur::Ports& ports) {
  return ports.shadowValues && ports.shadowValues->layers > 0;
}

int layersOf(const ShadowBlur::Params& params, const ShadowBlur::Ports& ports) {
  if (params.penumbrae == ShadowBlur::From::Sampled)
    return ports.nearestBlockers ? ports.layers() : 0;
  return ports.penumbrae ? ports.penumbrae->layers : 0;
}

}  // namespace

const gpu::Program& ShadowBlur::programOf(const Params& params, const Ports& ports, bool first) {
  const int arrayLayers = render::arrayLayersOf(layersOf(params, ports));
  gpu::ProgramDesc desc{.vertex = "gpu/fullscreen.vert",
                        .fragment = "passes/shadow_blur/shadow_blur.frag",
                        .defines = {{"ARRAY_LAYERS", std::to_string(arrayLayers)}}};
  if (first) desc.defines["OF_MASK"] = "1";
  if (first && hasValues(ports)) desc.defines["SHADOW_VALUES"] = "1";
  if (params.penumbrae == From::Sampled) {
    desc.defines["SAMPLED_PENUMBRAE"] = "1";
    defineLayerWidths(desc, ports);
  }
  if (params.resolution == render::LayerResolution::Half) desc.defines["HALF_SIZE"] = "1";
  if (params.variant == render::LayeredVariant::Published) desc.defines["PUBLISHED"] = "1";
  gpu::ProgramPtr& program = programs_[desc];
  if (!program) program = device_.program(desc);
  return *program;
}

void ShadowBlur::bind(gpu::Rendering& rendering, const gpu::Program& program, const Params& params,
                      const Ports& ports, bool first) {
  if (params.penumbrae == From::Sampled) {
    bindLayerWidths(rendering, program, params, ports, params.variant);
  } else {
    rendering.buffer("ViewBlock", ports.view->block);
    rendering.texture("depth", *ports.depth, gpu::kNearest);
    rendering.texture("normal", *ports.normal, gpu::kNearest);
    rendering.texture("penumbrae", ports.penumbrae->widths, gpu::kNearest);
    program.set("penumbraScale", ports.penumbrae->scale);
  }
  if (!first)
    rendering.texture("alongX", along_, gpu::kNearest);
  else if (hasValues(ports))
    rendering.texture("shadowValues", ports.shadowValues->bytes, gpu::kNearest);
  else
    rendering.texture("shadowMask", *ports.shadowMask, gpu::kNearest);
}

void ShadowBlur::blur(const Params& params, const Ports& ports, bool first,
                      const gpu::Texture& to) {
  gpu::Rendering rendering = device_.render(render::targetsOf(to));
  const gpu::Program& program = programOf(params, ports, first);
  rendering.use(program, {.cull = gpu::Cull::None});
  bind(rendering, program, params, ports, first);
  program.set("taps", params.kernel / 2);
  program.set("maximumRadius", params.maximumRadius);
  program.set("edgeStop", params.edgeStop);
  rendering.fullscreen();
}

void ShadowBlur::execute(graph::PassContext&, const Params& params, const Ports& ports) {
  render::LayeredShadows& out = *ports.layeredShadows;
  out.layers = layersOf(params, ports);
  out.scale = scaleOf(params.resolution);
  for (gpu::Texture* texture : {&along_, &out.visibility})
    render::fitLayers(device_, *texture, Format::R32Uint, *ports.depth, out.scale, out.layers,
                      "layered shadows");
  if (out.layers == 0) return;
  blur(params, ports, true, along_);
  blur(params, ports, false, out.visibility);
}

}  // namespace lucerna::passes
