#include "passes/prefiltered_shadows/prefiltered_shadows.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace lucerna::passes {

namespace {

constexpr int kWidestKernel = 47;

// The weights of a Gaussian's taps by their distance from its middle, which add up to 1. It goes as
// far as 2.5 standard deviations. kernel: its width; texels: the taps' distance, in the same unit.
std::vector<float> weightsOf(int kernel, int texels) {
  const int taps = (kernel / 2 + texels - 1) / texels;
  const double deviation = kernel / 5. / texels;
  std::vector<double> exact;
  double sum = 0;
  for (int i = 0; i <= taps; ++i) {
    exact.push_back(std::exp(-0.5 * i * i / (deviation * deviation)));
    sum += (i == 0 ? 1 : 2) * exact.back();
  }
  std::vector<float> weights;
  for (const double weight : exact) weights.push_back(static_cast<float>(weight / sum));
  return weights;
}

// Of the places that a lookup takes together, texels of the map: the blur's taps, the squares that
// they stand for, and the two that a bilinear tap mixes.
float deviationOf(const std::vector<float>& weights, int texels) {
  double taps = 0;
  for (std::size_t i = 1; i < weights.size(); ++i)
    taps += 2. * static_cast<double>(weights[i]) * static_cast<double>(i * i);
  return static_cast<float>(texels * std::sqrt(taps + 1. / 12. + 1. / 4.));
}

// As `maps`, with a texel for each square of its texels; a little larger where halves would not be
// whole.
gpu::TextureDesc descOf(const gpu::Texture& maps, int texels, bool levels) {
  int side = (maps.width() + texels - 1) / texels, count = 1;
  if (levels) {
    while (side >> count >= render::PrefilteredShadows::kCoarsestSide) ++count;
    const int multiple = 1 << (count - 1);
    side = (side + multiple - 1) / multiple * multiple;
  }
  return {.kind = gpu::TextureKind::Array2D,
          .format = gpu::Format::Rgba32Float,
          .width = side,
          .height = side,
          .layers = maps.desc().layers,
          .levels = count};
}

int texelsOf(PrefilteredShadows::Resolution resolution) {
  return 1 << static_cast<int>(resolution);
}

void fit(gpu::Device& device, render::PrefilteredShadows& shadows, bool local,
         const gpu::TextureDesc& desc) {
  gpu::Texture& texture = local ? shadows.local : shadows.directional;
  if (texture && texture.desc() == desc) return;
  texture = {};  // before the new one is made
  std::erase_if(shadows.made, [&](const render::PrefilteredShadows::Made& made) {
    return made.drawn.place.local == local;
  });
  texture = device.createTexture(desc, "moments of shadow maps",
                                 "set resolution of PrefilteredShadows lower");
}

}  // namespace

void PrefilteredShadows::describe(graph::PassInfo<Params, Ports>& d) {
  d.pass("PrefilteredShadows",
         "Blurs moments of the depths in shadow maps, so that a lookup needs one tap.");
  d.runs(graph::Frequency::PerViewGroup);
  d.param("penumbra", &Params::penumbra)
      .choices({"kernel", "light"})
      .help(
          "kernel: as wide as the blur makes it; light: as wide as the light's size makes it, from "
          "levels of wider and wider blur.");
  d.param("kernel", &Params::kernel)
      .range(1, kWidestKernel)
      .unit("px")
      .help(
          "Width of the blur, of the first level, in texels of a shadow map; its standard "
          "deviation is a fifth of it.");
  d.param("resolution", &Params::resolution)
      .choices({"full", "half", "quarter"})
      .help("Of the moments along each side, as a share of the maps'.");
  d.param("redraw", &Params::redraw)
      .choices({"changed", "always"})
      .help(
          "changed: what belongs to a map is made where the map has changed; always: in every "
          "frame.");
  d.read("shadowMaps", &Ports::shadowMaps)
      .optional()
      .help("What each light sees; without it nothing is made.");
  d.write("prefilteredShadows", &Ports::prefilteredShadows).help("Moments, layer for layer.");
}

PrefilteredShadows::PrefilteredShadows(gpu::Device& device) {
  const auto program = [&](const char* shader, std::map<std::string, std::string> defines = {}) {
    return device.program({.vertex = "gpu/fullscreen.vert",
                           .fragment = fmt::format("passes/prefiltered_shadows/{}.frag", shader),
                           .defines = std::move(defines)});
  };
  for (const Resolution resolution : {Resolution::Full, Resolution::Half, Resolution::Quarter})
    moments_[static_cast<std::size_t>(resolution)] =
        program("moments", {{"TEXELS", std::to_string(texelsOf(resolution))}});
  blur_ = program("blur");
  halve_ = program("halve");
}

// Into between_[0].
void PrefilteredShadows::makeMoments(gpu::Device& device, Resolution resolution,
                                     const gpu::Texture& maps, const render::ShadowMaps::Map& map,
                                     const gpu::Rect& viewport) {
  gpu::Rendering rendering =
      device.render({.colors = {{&between_[0], gpu::Load::Discard}}, .viewport = viewport});
  const gpu::Program& program = *moments_[static_cast<std::size_t>(resolution)];
  rendering.use(program, {.cull = gpu::Cull::None});
  rendering.texture("shadowMaps", maps, gpu::kNearest);
  program.set("layer", map.place.layer);
  program.set("corner", map.place.corner);
  program.set("side", ivec2(map.place.side));
  program.set("directional", !map.place.local);
  program.set("lampShare", map.projection.clipFromView[2][2]);
  rendering.fullscreen();
}

void PrefilteredShadows::blur(gpu::Device& device, const gpu::Texture& from, const gpu::Targets& to,
                              ivec2 axis, const std::vector<float>& weights) {
  gpu::Rendering rendering = device.render(to);
  rendering.use(*blur_, {.cull = gpu::Cull::None});
  rendering.texture("unblurred", from, gpu::kNearest);
  blur_->set("side", ivec2(to.viewport.width, to.viewport.height));
  blur_->set("corner", ivec2(to.viewport.x, to.viewport.y));
  blur_->set("axis", axis);
  blur_->set("taps", static_cast<int>(weights.size()) - 1);
  blur_->set("weights", std::span(weights));
  rendering.fullscreen();
}

// rect: of the map in level 0.
void PrefilteredShadows::makeLevels(gpu::Device& device, const gpu::Texture& texture, int layer,
                                    const gpu::Rect& rect) {
  for (int level = 1; level < texture.desc().levels &&
                      rect.width >> level >= render::PrefilteredShadows::kCoarsestSide;
       ++level) {
    gpu::Rendering rendering =
        device.render({.colors = {{.texture = &texture, .layer = layer, .level = level}},
                       .viewport = {rect.x >> level, rect.y >> level, rect.width >> level,
                                    rect.height >> level}});
    rendering.use(*halve_, {.cull = gpu::Cull::None});
    rendering.texture("levels", texture, gpu::kNearest);
    halve_->set("layer", layer);
    halve_->set("finer", level - 1);
    halve_->set("corner", ivec2(rect.x, rect.y) >> (level - 1));
    halve_->set("side", ivec2(rect.width, rect.height) >> (level - 1));
    rendering.fullscreen();
  }
}

void PrefilteredShadows::prefilter(gpu::Device& device, const Params& params, const Ports& ports,
                                   const render::ShadowMaps::Map& map) {
  const render::PrefilteredShadows& out = *ports.prefilteredShadows;
  const render::ShadowMaps::Place& place = map.place;
  const gpu::Texture& result = place.local ? out.local : out.directional;
  const ivec2 corner = place.corner / out.texels;
  // That of a directional light fills its layer.
  const int side = place.local ? place.side / out.texels : result.width();
  const gpu::Rect rect{corner.x, corner.y, side, side};
  const gpu::Rect alone{0, 0, rect.width, rect.height};
  const std::vector<float> weights = weightsOf(params.kernel | 1, out.texels);
  makeMoments(device, params.resolution,
              place.local ? ports.shadowMaps->local : ports.shadowMaps->directional, map, alone);
  blur(device, between_[0], {.colors = {{&between_[1], gpu::Load::Discard}}, .viewport = alone},
       {1, 0}, weights);
  blur(device, between_[1],
       {.colors = {{.texture = &result, .layer = place.layer}}, .viewport = rect}, {0, 1}, weights);
  makeLevels(device, result, place.layer, rect);
}

void PrefilteredShadows::execute(graph::PassContext& context, const Params& params,
                                 const Ports& ports) {
  render::PrefilteredShadows& out = *ports.prefilteredShadows;
  if (!ports.shadowMaps) {
    out = {};
    return;
  }
  const render::ShadowMaps& maps = *ports.shadowMaps;
  const int kernel = params.kernel | 1;
  out.levels = params.penumbra == Penumbra::Light;
  out.texels = texelsOf(params.resolution);
  out.deviation = deviationOf(weightsOf(kernel, out.texels), out.texels);
  fit(context.device, out, false, descOf(maps.directional, out.texels, out.levels));
  fit(context.device, out, true, descOf(maps.local, out.texels, out.levels));
  const int side = std::max(out.directional.width(), out.local.width());
  for (gpu::Texture& texture : between_)
    if (!texture || texture.width() != side)
      texture = context.device.createTexture(
          {.format = gpu::Format::Rgba32Float, .width = side, .height = side}, "moments");
  for (const render::ShadowMaps::Map& map : maps.maps) {
    const auto drawn = std::ranges::find(maps.drawn, map.place, &render::ShadowMaps::Drawn::place);
    const render::PrefilteredShadows::Made wanted{*drawn, kernel};
    if (params.redraw == Redraw::Changed && std::ranges::find(out.made, wanted) != out.made.end())
      continue;
    prefilter(context.device, params, ports, map);
    std::erase_if(out.made, [&](const render::PrefilteredShadows::Made& made) {
      return made.drawn.place.overlaps(map.place);
    });
    out.made.push_back(wanted);
  }
}

}  // namespace lucerna::passes
