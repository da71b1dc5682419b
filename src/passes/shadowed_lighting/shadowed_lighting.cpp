#include "passes/shadowed_lighting/shadowed_lighting.hpp"

#include <algorithm>

namespace lucerna::passes {

void ShadowedLighting::describe(graph::PassInfo<Params, Ports>& d) {
  d.pass("ShadowedLighting",
         "Shades the G-buffer with the ambient light and all lights, less what shadow maps block.");
  d.param("ambient", &Params::ambient).range(0, 100).help("Factor on the scene's ambient light.");
  d.param("filter", &Params::filter)
      .choices({"nearest", "hardware", "3x3", "5x5", "7x7", "9x9"})
      .help(
          "Percentage-closer filtering: one comparison, the mean of the four around the point, or "
          "that of so many such means a texel apart.");
  d.param("bias", &Params::bias)
      .range(0, 100)
      .unit("m")
      .help("How far a point is moved towards the light before it is compared.");
  d.param("normalBias", &Params::normalBias)
      .range(0, 16)
      .help(
          "How far a point is moved off its surface before it is compared, as a factor on what "
          "keeps a plane from shadowing itself: the filter's reach there times the slope.");
  describeDeferred(d, 1,
                   "Linear radiance, emission included. Pixels of custom shaders that were drawn "
                   "before darken; those where nothing was drawn stay as they were; black if "
                   "nothing was there.");
  d.read("scene", &Ports::scene).help("Whether there are custom shaders, whose pixels darken.");
  d.read("shadowMaps", &Ports::shadowMaps)
      .optional()
      .help("What each light sees; without it there are no shadows.");
}

ShadowedLighting::ShadowedLighting(gpu::Device& device)
    : lighting_(device, "passes/shadowed_lighting/shadowed_lighting.frag"),
      darkening_(device, "passes/shadowed_lighting/darken.frag") {
  prepareShadowMaps(device, noMaps_, {}, {});
}

void ShadowedLighting::execute(graph::PassContext& context, const Params& params,
                               const Ports& ports) {
  gpu::Rendering rendering = beginDeferred(context.device, ports);
  render::bindShadowMaps(rendering, ports.shadowMaps ? *ports.shadowMaps : noMaps_,
                         params.filter != Filter::Nearest);

  const int radius = std::max(static_cast<int>(params.filter) - 1, 0);
  const auto draw = [&](const render::DeferredProgram& programs, gpu::Blend blend) {
    const gpu::Program& program = programs.of(ports);
    rendering.use(program, render::deferredState(blend));
    program.set("ambientScale", params.ambient);
    program.set("shadowFilterRadius", radius);
    program.set("shadowFilterReach",
                params.filter == Filter::Nearest ? 0.5f : static_cast<float>(radius) + 1.f);
    program.set("shadowBias", params.bias);
    program.set("shadowNormalBias", params.normalBias);
    rendering.fullscreen();
  };
  const bool anyCustom =
      std::ranges::any_of(ports.scene->scene->materials,
                          [](const scene::Material& material) { return material.shader.used(); });
  if (anyCustom && !ports.color.isNew()) draw(darkening_, gpu::Blend::Multiply);
  draw(lighting_, gpu::Blend::Off);
}

}  // namespace lucerna::passes
