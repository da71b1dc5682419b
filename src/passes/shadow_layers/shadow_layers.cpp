#include "passes/shadow_layers/shadow_layers.hpp"

#include <algorithm>

#include "core/log.hpp"

namespace lucerna::passes {

void ShadowLayers::describe(graph::PassInfo<Params, Ports>& d) {
  d.pass("ShadowLayers",
         "Puts lights whose lit volumes do not meet into one layer of screen-space shadows.");
  d.runs(graph::Frequency::PerViewGroup);
  d.param("layers", &Params::layers)
      .range(1, 32)
      .help("Most layers. Lights that none is left for get hard shadows, and a warning names them.");
  d.param("order", &Params::order)
      .choices({"degree", "saturation"})
      .help(
          "Which light gets its layer next. degree: that which overlaps fewest (system C); "
          "saturation: that whose neighbours have most layers (DSATUR).");
  d.param("sunAlone", &Params::sunAlone)
      .help("Directional lights come first, each in a layer of its own.");
  d.read("scene", &Ports::scene).help("For the lights' names.");
  d.read("lights", &Ports::lights).help("Lights that are on.");
  d.read("shadowMaps", &Ports::shadowMaps).help("Which of them throw shadows.");
  d.write("shadowLayers", &Ports::shadowLayers).help("The layer of each light.");
}

void ShadowLayers::warnOf(const std::vector<std::string>& beyond, int layers) {
  std::string names;
  for (const std::string& name : beyond)
    if (warned_.insert(name).second) names += (names.empty() ? "'" : ", '") + name + "'";
  if (!names.empty())
    log::warning("ShadowLayers: beyond {} layers {} have hard shadows; layers allows more", layers,
                 names);
}

void ShadowLayers::execute(graph::PassContext& context, const Params& params,
                           const Ports& ports) {
  const std::vector<scene::PlacedLight>& lights = ports.lights->lights;
  std::vector<bool> shadowed;
  std::vector<std::uint32_t> suns;
  for (std::uint32_t i = 0; i < lights.size(); ++i) {
    shadowed.push_back(ports.shadowMaps->ofLight[i].count > 0);
    if (params.sunAlone && shadowed[i] && lights[i].kind == scene::LightKind::Directional)
      suns.push_back(i);
  }
  render::ShadowLayers& out = *ports.shadowLayers;
  out.ofLight = colourLights(overlapsOf(lights, shadowed), shadowed, suns, params.order,
                             params.layers);
  out.count = 0;
  std::vector<std::string> beyond;
  for (std::uint32_t i = 0; i < lights.size(); ++i) {
    out.count = std::max(out.count, out.ofLight[i] + 1);
    if (shadowed[i] && out.ofLight[i] == kNoLayer)
      beyond.push_back(ports.scene->scene->lights[lights[i].light].name);
  }
  warnOf(beyond, params.layers);
  std::vector<int> values = out.ofLight;
  values.resize(std::max<std::size_t>(values.size(), 1), kNoLayer);  // none cannot be bound
  context.device.write(out.block, std::as_bytes(std::span(values)), "ShadowLayerBlock");
}

}  // namespace lucerna::passes
