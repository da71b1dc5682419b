#include "passes/shadow_layers/shadow_layers.hpp"

#include <algorithm>
#include <cstring>

#include "core/log.hpp"

namespace lucerna::passes {
namespace {

constexpr int kMostLayers = 32;  // bits of ShadowMask

}  // namespace

void ShadowLayers::describe(graph::PassInfo<Params, Ports>& d) {
  d.pass("ShadowLayers",
         "Puts lights whose lit volumes do not meet into one layer of screen-space shadows.");
  d.param("layers", &Params::layers)
      .range(1, kMostLayers)
      .help(
          "Most layers. Lights that none is left for get hard shadows, and a warning names them.");
  d.param("conflicts", &Params::conflicts)
      .choices({"spheres", "tiles"})
      .rebuilds(graph::Rebuild::Ports)
      .help(
          "Which lights may not share a layer. spheres: those whose lit volumes may meet, by "
          "spheres around them (system C); tiles: those that both reach what is seen in some "
          "tile, or in tiles near each other.");
  d.param("apart", &Params::apart)
      .range(0, 512)
      .unit("px")
      .help(
          "tiles: how far what lights of one layer reach is to be apart: as far as ShadowBlur "
          "reaches, or the shadow of one falls into the light of another.");
  d.param("order", &Params::order)
      .choices({"degree", "saturation"})
      .help(
          "Which light gets its layer next. degree: that which overlaps fewest (system C); "
          "saturation: that whose neighbours have most layers (DSATUR).");
  d.param("sunAlone", &Params::sunAlone)
      .help("Directional lights come first, each in a layer of its own.");
  d.param("variant", &Params::variant)
      .choices({"mended", "published"})
      .help(
          "published: what system C starts from (its figure 3), one layer for all lights with the "
          "mean of their penumbrae.");
  d.read("scene", &Ports::scene).help("For the lights' names.");
  d.read("lights", &Ports::lights).help("Lights that are on.");
  d.read("shadowMaps", &Ports::shadowMaps).help("Which of them throw shadows.");
  if (d.values().conflicts == Conflicts::Tiles)
    d.read("tileLights", &Ports::tileLights)
        .optional()
        .help("Which lights reach a tile; without it spheres decide.");
  d.write("shadowLayers", &Ports::shadowLayers).help("The layer of each light.");
}

void ShadowLayers::warnOf(const std::vector<std::string>& beyond, int layers) {
  std::string names;
  for (const std::string& name : beyond)
    if (warned_.insert(name).second) names += (names.empty() ? "'" : ", '") + name + "'";
  if (names.empty()) return;
  const std::string more =
      layers < kMostLayers
          ? fmt::format("raise ShadowLayers.layers (now {}, at most {})", layers, kMostLayers)
          : "there are no more";
  log::warning("ShadowLayers: {} lights need more than {} {}, and have hard shadows; {}: {}",
               beyond.size(), layers, layers == 1 ? "layer" : "layers", more, names);
}

OverlapGraph ShadowLayers::overlaps(gpu::Device& device, const Params& params, const Ports& ports,
                                    const std::vector<bool>& shadowed) {
  if (params.conflicts == Conflicts::Spheres || !ports.tileLights)
    return overlapsOf(ports.lights->lights, shadowed);
  const std::size_t words = (shadowed.size() + 31) / 32;
  std::vector<std::uint32_t> bits(std::max<std::size_t>(shadowed.size() * words, 1));
  device.write(conflicts_, std::as_bytes(std::span(bits)), "ConflictBlock");
  {
    gpu::Computing computing = device.compute();
    computing.use(*conflictsProgram_);
    computing.buffer("LightBlock", ports.lights->block);
    computing.buffer("TileLightBlock", ports.tileLights->block);
    computing.buffer("ConflictBlock", conflicts_);
    conflictsProgram_->set("tiles", static_cast<int>(ports.tileLights->tiles));
    conflictsProgram_->set("reach", (params.apart + render::kLightTile - 1) / render::kLightTile);
    computing.dispatch((ports.tileLights->tiles + 63) / 64);
  }
  device.barrier();
  const std::vector<std::byte> found = device.download(conflicts_);
  std::memcpy(bits.data(), found.data(), bits.size() * sizeof(bits[0]));
  return overlapsOf(bits, shadowed);
}

void ShadowLayers::execute(graph::PassContext& context, const Params& params, const Ports& ports) {
  const std::vector<scene::PlacedLight>& lights = ports.lights->lights;
  std::vector<bool> shadowed;
  std::vector<std::uint32_t> suns;
  for (std::uint32_t i = 0; i < lights.size(); ++i) {
    shadowed.push_back(ports.shadowMaps->ofLight[i].count > 0);
    if (params.sunAlone && shadowed[i] && lights[i].kind == scene::LightKind::Directional)
      suns.push_back(i);
  }
  render::ShadowLayers& out = *ports.shadowLayers;
  out.shared = params.variant == render::LayeredVariant::Published;
  if (out.shared) {
    out.ofLight.clear();
    for (const bool throws : shadowed) out.ofLight.push_back(throws ? 0 : kNoLayer);
  } else {
    out.ofLight = colourLights(overlaps(context.device, params, ports, shadowed), shadowed, suns,
                               params.order, params.layers);
  }
  out.count = 0;
  std::vector<std::string> beyond;
  for (std::uint32_t i = 0; i < lights.size(); ++i) {
    out.count = std::max(out.count, out.ofLight[i] + 1);
    if (shadowed[i] && out.ofLight[i] == kNoLayer)
      beyond.push_back(ports.scene->scene->lights[lights[i].light].name);
  }
  out.beyond = static_cast<int>(beyond.size());
  warnOf(beyond, params.layers);
  std::vector<int> values = out.ofLight;
  values.resize(std::max<std::size_t>(values.size(), 1), kNoLayer);  // none cannot be bound
  context.device.write(out.block, std::as_bytes(std::span(values)), "ShadowLayerBlock");
}

}  // namespace lucerna::passes
