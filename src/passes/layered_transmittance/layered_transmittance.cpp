#include "passes/layered_transmittance/layered_transmittance.hpp"

#include <algorithm>

namespace lucerna::passes {

using gpu::Format;

namespace {

constexpr int kSlotsOfTexel = 4;
constexpr int kArraysAtOnce = 4;  // two targets for each
// As in render/pane_slots.glsl.
constexpr int kNoPanes = -1, kPanesInMaps = -2;

struct Slots {
  std::vector<int> ofLight;
  int count = 0;
};

// A slot for each layer of which some light's maps see panes.
Slots slotsOf(const LayeredTransmittance::Ports& ports) {
  Slots slots;
  std::vector<int> ofLayer(static_cast<std::size_t>(ports.layers()), -1);
  for (std::size_t i = 0; i < ports.shadowMaps->ofLight.size(); ++i) {
    const render::ShadowMaps::Range& range = ports.shadowMaps->ofLight[i];
    const auto maps = std::span(ports.shadowMaps->maps).subspan(range.first, range.count);
    const int layer = ports.shadowLayers->ofLight[i];
    if (std::ranges::none_of(maps, &render::ShadowMaps::Map::seesPanes)) {
      slots.ofLight.push_back(kNoPanes);
    } else if (layer < 0 || ports.shadowLayers->shared) {
      slots.ofLight.push_back(kPanesInMaps);
    } else {
      int& slot = ofLayer[static_cast<std::size_t>(layer)];
      if (slot < 0) slot = slots.count++;
      slots.ofLight.push_back(slot);
    }
  }
  return slots;
}

}  // namespace

void LayeredTransmittance::describe(graph::PassInfo<Params, Ports>& d) {
  d.pass("LayeredTransmittance",
         "Finds how translucent surfaces colour each layer's light, and blurs it by the width of "
         "their penumbrae.");
  describeWidths(d);
  describePenumbraBlur(d);
  describeLayerLookup(d, render::haloOf(d.values()));
  if (d.values().method == Method::Minimum)
    d.read("nearestBlockers", &Ports::nearestBlockers)
        .optional()
        .help("Small copies of the maps; without it nothing is done.");
  d.write("layeredTransmittance", &Ports::layeredTransmittance)
      .help("Colours of layers whose light meets translucent surfaces; of none without them.");
}

const gpu::Program& LayeredTransmittance::programOf(const gpu::ProgramDesc& desc) {
  gpu::ProgramPtr& program = programs_[desc];
  if (!program) program = device_.program(desc);
  return *program;
}

void LayeredTransmittance::makeTextures(const Ports& ports) {
  render::LayeredTransmittance& out = *ports.layeredTransmittance;
  const auto fit = [&](gpu::Texture& texture, Format format, int slots) {
    render::fitLayers(device_, texture, format, *ports.depth, out.scale, slots,
                      "layered transmittance");
  };
  fit(out.colors, Format::Rgba32Uint, out.slots);
  const int atOnce = std::min(out.slots, kSlotsOfTexel * kArraysAtOnce);
  fit(hard_, Format::Rgba32Uint, atOnce);
  fit(widths_, Format::Rgba16Float, atOnce);
  fit(alongX_, Format::Rgba32Uint, std::min(out.slots, kSlotsOfTexel));
}

void LayeredTransmittance::findHard(const Params& params, const Ports& ports, int first,
                                    int count) {
  gpu::ProgramDesc desc{.vertex = "gpu/fullscreen.vert",
                        .fragment = "passes/layered_transmittance/hard_transmittance.frag",
                        .defines = {{"ARRAY_LAYERS", std::to_string(count)}}};
  const bool byNearest = params.method == Method::Minimum;
  if (byNearest) desc.defines["NEAREST_BLOCKERS"] = "1";
  if (ports.tiled()) desc.defines["TILE_LIGHTS"] = "1";
  const gpu::Program& program = programOf(desc);
  gpu::Targets targets;
  for (const gpu::Texture* texture : {&hard_, &widths_})
    for (int layer = 0; layer < count; ++layer)
      targets.colors.push_back({texture, gpu::Load::Discard, vec4(0.f), layer});
  gpu::Rendering rendering = device_.render(targets);
  rendering.use(program, {.cull = gpu::Cull::None});
  bindLayerLookup(rendering, program, params, ports, render::kPlaneReach);
  rendering.buffer("PaneSlotBlock", ports.layeredTransmittance->slotBlock);
  if (byNearest) {
    rendering.texture("directionalNearestBlockers", ports.nearestBlockers->directionalPanes,
                      gpu::kNearest);
    rendering.texture("localNearestBlockers", ports.nearestBlockers->localPanes, gpu::kNearest);
  } else {
    program.set("shadowSearchRadius", params.search / 2);
  }
  program.set("scale", ports.layeredTransmittance->scale);
  program.set("firstSlot", kSlotsOfTexel * first);
  rendering.fullscreen();
}

void LayeredTransmittance::blurAxis(const Params& params, const Ports& ports, int layer,
                                    bool alongX, const gpu::ColorTarget& to) {
  gpu::ProgramDesc desc{.vertex = "gpu/fullscreen.vert",
                        .fragment = "passes/layered_transmittance/blur_transmittance.frag"};
  if (alongX) desc.defines["ALONG_X"] = "1";
  if (params.resolution == render::LayerResolution::Half) desc.defines["HALF_SIZE"] = "1";
  const gpu::Program& program = programOf(desc);
  gpu::Rendering rendering = device_.render({.colors = {to}});
  rendering.use(program, {.cull = gpu::Cull::None});
  rendering.buffer("ViewBlock", ports.view->block);
  rendering.texture("colors", alongX ? hard_ : alongX_, gpu::kNearest);
  rendering.texture("widths", widths_, gpu::kNearest);
  rendering.texture("depth", *ports.depth, gpu::kNearest);
  rendering.texture("normal", *ports.normal, gpu::kNearest);
  program.set("colorLayer", alongX ? layer : 0);
  program.set("widthLayer", layer);
  program.set("taps", params.kernel / 2);
  program.set("maximumRadius", params.maximumRadius);
  program.set("edgeStop", params.edgeStop);
  rendering.fullscreen();
}

void LayeredTransmittance::blur(const Params& params, const Ports& ports, int layer,
                                const gpu::ColorTarget& to) {
  blurAxis(params, ports, layer, true, {&alongX_, gpu::Load::Discard, vec4(0.f), 0});
  blurAxis(params, ports, layer, false, to);
}

void LayeredTransmittance::execute(graph::PassContext&, const Params& params, const Ports& ports) {
  render::LayeredTransmittance& out = *ports.layeredTransmittance;
  Slots slots;
  const bool hasWidths = params.method == Method::Search || ports.nearestBlockers;
  if (hasWidths && ports.layers() > 0 && ports.shadowMaps->seesPanes()) slots = slotsOf(ports);
  out.slots = slots.count;
  out.scale = scaleOf(params.resolution);
  makeTextures(ports);
  if (out.slots == 0) return;
  device_.write(out.slotBlock, std::as_bytes(std::span(slots.ofLight)), "PaneSlotBlock");
  const int arrays = render::arrayLayersOf(out.slots);
  for (int first = 0; first < arrays; first += kArraysAtOnce) {
    const int count = std::min(arrays - first, kArraysAtOnce);
    findHard(params, ports, first, count);
    for (int layer = 0; layer < count; ++layer)
      blur(params, ports, layer, {&out.colors, gpu::Load::Discard, vec4(0.f), first + layer});
  }
}

}  // namespace lucerna::passes
