#include "passes/tiled_lighting/tiled_lighting.hpp"

#include <algorithm>
#include <utility>

#include "core/log.hpp"
#include "render/layer_lookup.hpp"

namespace lucerna::passes {

using gpu::Format;

namespace {

void describeShadows(graph::PassInfo<TiledLighting::Params, TiledLighting::Ports>& d) {
  using Params = TiledLighting::Params;
  d.param("shadows", &Params::shadows)
      .choices({"none", "hard", "pcf", "pcss", "prefiltered", "layered"})
      .rebuilds(graph::Rebuild::Ports)
      .help(
          "hard: one comparison with the shadow map; pcf: percentage-closer filtering, the mean of "
          "kernel x kernel comparisons a texel apart; pcss: percentage-closer soft shadows, that "
          "of comparisons all over the penumbra, whose width follows from a search for blockers; "
          "prefiltered: a tap or two of the moments that PrefilteredShadows makes; layered: what "
          "ShadowBlur makes in screen space, hard shadows of lights without a "
          "layer.");
  d.param("kernel", &Params::kernel)
      .range(1, 47)
      .help("pcf, pcss: comparisons along each side, odd; an even number is taken as the next.");
  d.param("search", &Params::search)
      .range(3, 47)
      .help("pcss: depths along each side that are searched for blockers, odd.");
  d.param("comparison", &Params::comparison)
      .choices({"nearest", "filtered", "plane"})
      .help(
          "nearest: with one depth; filtered: the hardware's mean of those with the four around; "
          "plane: that mean, each compared where it lies on the surface's plane, which a third of "
          "the offset keeps from shadowing itself.");
  render::describeShadowBias(d, &Params::bias, &Params::normalBias);
}

bool hasMoments(const TiledLighting::Ports& ports) {
  return ports.shadowMaps && ports.prefilteredShadows && ports.prefilteredShadows->local;
}

// Null ports: `shadows` is not layered.
bool hasLayers(const TiledLighting::Ports& ports) {
  return ports.shadowMaps && ports.shadowLayers && ports.shadowMask && ports.layeredShadows &&
         ports.layeredShadows->layers > 0;
}

float reachOf(TiledLighting::Comparison comparison) {
  switch (comparison) {
    case TiledLighting::Comparison::Nearest:
      return render::kNearestReach;
    case TiledLighting::Comparison::Filtered:
      return render::kFilteredReach;
    case TiledLighting::Comparison::Plane:
      return render::kPlaneReach;
  }
  return render::kFilteredReach;
}

// Lights throw shadows, and some row that would soften them is missing or disabled.
bool lacksLayers(const TiledLighting::Ports& ports) {
  return ports.shadowMaps && !ports.shadowMaps->maps.empty() && !hasLayers(ports) &&
         !(ports.shadowLayers && ports.shadowLayers->count == 0);
}

bool hasPanesInLayers(const TiledLighting::Ports& ports) {
  return ports.shadowMaps && ports.shadowMaps->seesPanes() && ports.layeredTransmittance &&
         ports.layeredTransmittance->slots > 0;
}

// SHADOW_FILTER of render/shadows.glsl; 0: without.
int filterOf(TiledLighting::Shadows shadows) {
  if (shadows == TiledLighting::Shadows::Pcf) return 1;
  return shadows == TiledLighting::Shadows::Pcss ? 2 : 0;
}

}  // namespace

void TiledLighting::describe(graph::PassInfo<Params, Ports>& d) {
  d.pass("TiledLighting",
         "Shades the G-buffer with the ambient light and all lights, less what shadow maps block.");
  d.param("ambient", &Params::ambient).range(0, 100).help("Factor on the scene's ambient light.");
  describeShadows(d);
  const bool shadows = d.values().shadows != Shadows::None;
  d.read("view", &Ports::view).help("The view that the G-buffer was drawn from.");
  d.read("lights", &Ports::lights).help("Lights that are on, and the ambient light.");
  d.read("tileLights", &Ports::tileLights)
      .optional()
      .help("Which lights may reach a pixel; without it each pixel tries them all.");
  d.read("depth", &Ports::depth)
      .texture(Format::Depth32F)
      .halo(shadows ? 1 : 0)
      .help("Reversed depth.");
  const auto read = [&](const char* name, graph::In<gpu::Texture> Ports::* member, Format format,
                        const char* help) {
    auto port = d.read(name, member);
    port.texture(format).sameSizeAs("depth").help(help);
    return port;
  };
  read("normal", &Ports::normal, Format::Rg16Unorm, "View-space normal, octahedral.");
  read("albedo", &Ports::albedo, Format::Srgb8Alpha8, "Diffuse or base colour.");
  read("specular", &Ports::specular, Format::Srgb8Alpha8,
       "Specular and occlusion of ambient light.");
  read("material", &Ports::material, Format::Rgba8Uint, "Type, shininess or roughness, metallic.");
  read("emissive", &Ports::emissive, Format::R11G11B10Float, "Radiance.");
  read("ambientVisibility", &Ports::ambientVisibility, Format::R8Unorm,
       "Share of the ambient light that arrives.")
      .optional();
  read("bakedIrradiance", &Ports::bakedIrradiance, Format::Rgba16Float,
       "Baked light, which is added; no shadow and no occlusion darkens it.")
      .optional();
  if (shadows) {
    d.read("scene", &Ports::scene).help("Whether there are custom shaders, whose pixels darken.");
    d.read("shadowMaps", &Ports::shadowMaps)
        .optional()
        .help("What each light sees; without it there are no shadows.");
  }
  if (d.values().shadows == Shadows::Prefiltered)
    d.read("prefilteredShadows", &Ports::prefilteredShadows)
        .optional()
        .help("Moments of what lights see; without it all lights have hard shadows.");
  if (d.values().shadows == Shadows::Layered) {
    d.read("shadowLayers", &Ports::shadowLayers).optional().help("The layer of each light.");
    d.read("shadowMask", &Ports::shadowMask)
        .texture(Format::R32Uint)
        .sameSizeAs("depth")
        .optional()
        .help("Hard shadows of layers, where no surface beside a pixel tells more.");
    d.read("layeredShadows", &Ports::layeredShadows)
        .optional()
        .help("What each layer lets through; without it all lights have hard shadows.");
    d.read("layeredTransmittance", &Ports::layeredTransmittance)
        .optional()
        .help("How panes colour layers; without it the maps say it, and their edges are hard.");
  }
  d.update("color", &Ports::color)
      .texture(Format::Rgba16Float)
      .sizeOf("depth")
      .sameSizeAs("depth")
      .optional()
      .whenDisabled(vec4(0.f, 0.f, 0.f, 1.f))
      .help(
          "Linear radiance, emission included. Pixels of custom shaders that were drawn before "
          "darken in shadows; those where nothing was drawn stay as they were; black if nothing "
          "was there.");
}

const gpu::Program& TiledLighting::programOf(const char* shader, const Params& params,
                                             const Ports& ports) {
  gpu::ProgramDesc desc{.vertex = "gpu/fullscreen.vert",
                        .fragment = fmt::format("passes/tiled_lighting/{}.frag", shader)};
  if (ports.ambientVisibility) desc.defines["AMBIENT_VISIBILITY"] = "1";
  if (ports.bakedIrradiance) desc.defines["BAKED_LIGHT"] = "1";
  if (ports.tileLights) desc.defines["TILE_LIGHTS"] = "1";
  if (ports.shadowMaps) desc.defines["SHADOWS"] = "1";
  if (ports.shadowMaps && ports.shadowMaps->seesPanes()) desc.defines["SHADOW_TRANSMISSION"] = "1";
  if (ports.shadowMaps && params.comparison == Comparison::Plane)
    desc.defines["PLANE_COMPARISON"] = "1";
  if (hasMoments(ports)) desc.defines["PREFILTERED_SHADOWS"] = "1";
  if (hasMoments(ports) && ports.prefilteredShadows->levels) desc.defines["MOMENT_LEVELS"] = "1";
  if (ports.shadowMaps && filterOf(params.shadows) > 0)
    desc.defines["SHADOW_FILTER"] = std::to_string(filterOf(params.shadows));
  if (hasLayers(ports))
    desc.defines["LAYERED_SHADOWS"] =
        std::to_string(render::arrayLayersOf(ports.layeredShadows->layers));
  if (hasPanesInLayers(ports)) desc.defines["LAYERED_TRANSMITTANCE"] = "1";
  if (hasLayers(ports) && ports.shadowLayers->beyond == 0) desc.defines["ALL_IN_LAYERS"] = "1";
  gpu::ProgramPtr& program = programs_[desc];
  if (!program) program = device_.program(desc);
  return *program;
}

// Draws onto `color`, made black if it is new, with everything bound that the ports hold.
gpu::Rendering TiledLighting::begin(gpu::Device& device, const Params& params, const Ports& ports) {
  gpu::Rendering rendering = device.render({
      .colors = {{ports.color.get(), ports.color.isNew() ? gpu::Load::Clear : gpu::Load::Keep,
                  vec4(0.f, 0.f, 0.f, 1.f)}},
      .depth = {ports.depth.get()},
  });
  rendering.buffer("ViewBlock", ports.view->block);
  rendering.buffer("LightBlock", ports.lights->block);
  if (ports.tileLights) rendering.buffer("TileLightBlock", ports.tileLights->block);
  rendering.texture("depth", *ports.depth, gpu::kNearest);
  rendering.texture("normal", *ports.normal, gpu::kNearest);
  rendering.texture("albedo", *ports.albedo, gpu::kNearest);
  rendering.texture("specular", *ports.specular, gpu::kNearest);
  rendering.texture("material", *ports.material, gpu::kNearest);
  rendering.texture("emissive", *ports.emissive, gpu::kNearest);
  if (ports.ambientVisibility)
    rendering.texture("ambientVisibility", *ports.ambientVisibility, gpu::kNearest);
  if (ports.bakedIrradiance)
    rendering.texture("bakedIrradiance", *ports.bakedIrradiance, gpu::kNearest);
  if (ports.shadowMaps)
    render::bindShadowMaps(rendering, *ports.shadowMaps, params.comparison == Comparison::Filtered);
  if (hasMoments(ports)) render::bindPrefilteredShadows(rendering, *ports.prefilteredShadows);
  if (hasLayers(ports)) {
    rendering.buffer("ShadowLayerBlock", ports.shadowLayers->block);
    rendering.texture("shadowMask", *ports.shadowMask, gpu::kNearest);
    rendering.texture("layeredShadows", ports.layeredShadows->visibility, gpu::kNearest);
  }
  if (hasPanesInLayers(ports)) {
    rendering.buffer("PaneSlotBlock", ports.layeredTransmittance->slotBlock);
    rendering.texture("layeredTransmittance", ports.layeredTransmittance->colors, gpu::kNearest);
  }
  return rendering;
}

// The triangle lies at depth 0 and passes where something nearer was drawn, so that empty pixels
// cost nothing. Depth is tested and read, never written.
void TiledLighting::draw(gpu::Rendering& rendering, const char* shader, const Params& params,
                         const Ports& ports, gpu::Blend blend) {
  const gpu::Program& program = programOf(shader, params, ports);
  rendering.use(program, {.depthTest = true,
                          .depthCompare = gpu::Compare::Less,
                          .blend = blend,
                          .cull = gpu::Cull::None});
  program.set("ambientScale", params.ambient);
  if (hasLayers(ports)) program.set("layerScale", ports.layeredShadows->scale);
  if (hasPanesInLayers(ports)) program.set("paneScale", ports.layeredTransmittance->scale);
  if (ports.shadowMaps) {
    program.set("shadowFilterRadius", params.kernel / 2);
    program.set("shadowSearchRadius", params.search / 2);
    program.set("shadowReach", reachOf(params.comparison));
    if (hasMoments(ports)) {
      program.set("shadowReach", ports.prefilteredShadows->deviation);
      program.set("momentDeviation", ports.prefilteredShadows->deviation);
      program.set("momentTexels", static_cast<float>(ports.prefilteredShadows->texels));
    }
    program.set("shadowBias", params.bias);
    program.set("shadowNormalBias", params.normalBias);
  }
  rendering.fullscreen();
}

void TiledLighting::execute(graph::PassContext& context, const Params& params, const Ports& ports) {
  if (params.shadows == Shadows::Layered && lacksLayers(ports) && !std::exchange(warned_, true))
    log::warning(
        "TiledLighting: shadows=layered finds no soft shadows, so that all are hard; before it, in "
        "this order: ShadowLayers, ShadowMask, (ShadowTiles,) NearestBlockers, Penumbra, "
        "ShadowBlur");
  gpu::Rendering rendering = begin(context.device, params, ports);
  const auto usesOwnShader = [](const scene::Material& material) { return material.shader.used(); };
  if (ports.shadowMaps && !ports.color.isNew() &&
      std::ranges::any_of(ports.scene->scene->materials, usesOwnShader))
    draw(rendering, "darken", params, ports, gpu::Blend::Multiply);
  draw(rendering, "tiled_lighting", params, ports, gpu::Blend::Off);
}

}  // namespace lucerna::passes
