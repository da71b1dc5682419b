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
  const double square = 1. * texels * texels;
  return static_cast<float>(std::sqrt(square * taps + square / 12. + square / 4.));
}

// As `maps`, with a texel for each square of its texels.
void fit(gpu::Device& device, gpu::Texture& texture, std::vector<render::ShadowMaps::Drawn>& made,
         const gpu::Texture& maps, int texels) {
  const int side = (maps.width() + texels - 1) / texels;
  const gpu::TextureDesc desc{.kind = gpu::TextureKind::Array2D,
                              .format = gpu::Format::Rgba32Float,
                              .width = side,
                              .height = side,
                              .layers = maps.desc().layers};
  if (texture && texture.desc() == desc) return;
  texture = {};  // before the new one is made
  made.assign(static_cast<std::size_t>(desc.layers), {});
  texture = device.createTexture(desc, "moments of " + maps.label(),
                                 "set resolution of PrefilteredShadows lower");
}

}  // namespace

void PrefilteredShadows::describe(graph::PassInfo<Params, Ports>& d) {
  d.pass("PrefilteredShadows",
         "Blurs moments of the depths in shadow maps, so that a lookup needs one tap.");
  d.runs(graph::Frequency::PerViewGroup);
  d.param("kernel", &Params::kernel)
      .range(1, kWidestKernel)
      .unit("px")
      .help(
          "Width of the blur in texels of a shadow map; its standard deviation is a fifth of it.");
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

PrefilteredShadows::PrefilteredShadows(gpu::Device& device)
    : moments_(device.program({.vertex = "gpu/fullscreen.vert",
                               .fragment = "passes/prefiltered_shadows/moments.frag"})),
      blur_(device.program(
          {.vertex = "gpu/fullscreen.vert", .fragment = "passes/prefiltered_shadows/blur.frag"})) {}

void PrefilteredShadows::prefilter(gpu::Device& device, const Ports& ports,
                                   const render::ShadowMaps::Map& map) {
  const render::PrefilteredShadows& out = *ports.prefilteredShadows;
  const gpu::Texture& maps = map.local ? ports.shadowMaps->local : ports.shadowMaps->directional;
  const gpu::Texture& result = map.local ? out.local : out.directional;
  // The map fills its layer.
  const gpu::Rect mapRect{0, 0, maps.width(), maps.height()};
  const gpu::Rect rect{0, 0, result.width(), result.height()};
  const gpu::Rect alone{0, 0, rect.width, rect.height};
  {
    gpu::Rendering rendering =
        device.render({.colors = {{&between_[0], gpu::Load::Discard}}, .viewport = alone});
    rendering.use(*moments_, {.cull = gpu::Cull::None});
    rendering.texture("shadowMaps", maps, gpu::kNearest);
    moments_->set("layer", map.layer);
    moments_->set("corner", ivec2(mapRect.x, mapRect.y));
    moments_->set("side", ivec2(mapRect.width, mapRect.height));
    moments_->set("texels", out.texels);
    moments_->set("directional", !map.local);
    moments_->set("lampShare", map.projection.clipFromView[2][2]);
    rendering.fullscreen();
  }
  const std::vector<float> weights = weightsOf(out.kernel, out.texels);
  const auto blur = [&](const gpu::Texture& from, const gpu::Targets& to, ivec2 axis) {
    gpu::Rendering rendering = device.render(to);
    rendering.use(*blur_, {.cull = gpu::Cull::None});
    rendering.texture("unblurred", from, gpu::kNearest);
    blur_->set("side", ivec2(alone.width, alone.height));
    blur_->set("corner", ivec2(to.viewport.x, to.viewport.y));
    blur_->set("axis", axis);
    blur_->set("taps", static_cast<int>(weights.size()) - 1);
    blur_->set("weights", std::span(weights));
    rendering.fullscreen();
  };
  blur(between_[0], {.colors = {{&between_[1], gpu::Load::Discard}}, .viewport = alone}, {1, 0});
  blur(between_[1], {.colors = {{.texture = &result, .layer = map.layer}}, .viewport = rect},
       {0, 1});
}

void PrefilteredShadows::execute(graph::PassContext& context, const Params& params,
                                 const Ports& ports) {
  render::PrefilteredShadows& out = *ports.prefilteredShadows;
  if (!ports.shadowMaps) {
    out = {};
    return;
  }
  const render::ShadowMaps& maps = *ports.shadowMaps;
  const int texels = 1 << static_cast<int>(params.resolution), kernel = params.kernel | 1;
  const bool all = params.redraw == Redraw::Always || out.texels != texels || out.kernel != kernel;
  out.texels = texels;
  out.kernel = kernel;
  out.deviation = deviationOf(weightsOf(kernel, texels), texels);
  fit(context.device, out.directional, out.madeDirectional, maps.directional, texels);
  fit(context.device, out.local, out.madeLocal, maps.local, texels);
  const int side = std::max(out.directional.width(), out.local.width());
  for (gpu::Texture& texture : between_)
    if (!texture || texture.width() != side)
      texture = context.device.createTexture(
          {.format = gpu::Format::Rgba32Float, .width = side, .height = side}, "moments");
  for (const render::ShadowMaps::Map& map : maps.maps) {
    const auto layer = static_cast<std::size_t>(map.layer);
    const auto& drawn = (map.local ? maps.drawnLocal : maps.drawnDirectional)[layer];
    auto& made = (map.local ? out.madeLocal : out.madeDirectional)[layer];
    if (!all && made == drawn) continue;
    prefilter(context.device, ports, map);
    made = drawn;
  }
}

}  // namespace lucerna::passes
