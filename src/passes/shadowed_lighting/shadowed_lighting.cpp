#include "passes/shadowed_lighting/shadowed_lighting.hpp"

#include <algorithm>

namespace lucerna::passes {

using gpu::Format;

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
          "keeps "
          "a plane from shadowing itself: a texel there, times the filter's radius and the slope.");
  render::readGBuffer(d, 1);
  d.read("scene", &Ports::scene).help("Whether there are custom shaders, whose pixels darken.");
  d.read("view", &Ports::view).help("The view that the G-buffer was drawn from.");
  d.read("lights", &Ports::lights).help("Lights that are on, and the ambient light.");
  d.read("shadowMaps", &Ports::shadowMaps)
      .optional()
      .help("What each light sees; without it there are no shadows.");
  d.read("ambientVisibility", &Ports::ambientVisibility)
      .texture(Format::R8Unorm)
      .sameSizeAs("depth")
      .optional()
      .help("Share of the ambient light that arrives.");
  d.update("color", &Ports::color)
      .texture(Format::Rgba16Float)
      .sizeOf("depth")
      .sameSizeAs("depth")
      .optional()
      .whenDisabled(vec4(0.f, 0.f, 0.f, 1.f))
      .help(
          "Linear radiance, emission included. Pixels of custom shaders that were drawn before "
          "darken; those where nothing was drawn stay as they were; black if nothing was there.");
}

ShadowedLighting::ShadowedLighting(gpu::Device& device) {
  const auto programs = [&](const char* fragment) {
    gpu::ProgramDesc desc{.vertex = "gpu/fullscreen.vert", .fragment = fragment};
    Programs result{.plain = device.program(desc)};
    desc.defines["AMBIENT_VISIBILITY"] = "1";
    result.occluded = device.program(desc);
    return result;
  };
  lighting_ = programs("passes/shadowed_lighting/shadowed_lighting.frag");
  darkening_ = programs("passes/shadowed_lighting/darken.frag");
  prepareShadowMaps(device, noMaps_, 1, 1);
}

void ShadowedLighting::execute(graph::PassContext& context, const Params& params,
                               const Ports& ports) {
  gpu::Rendering rendering = context.device.render({
      .colors = {{ports.color.get(), ports.color.isNew() ? gpu::Load::Clear : gpu::Load::Keep,
                  vec4(0.f, 0.f, 0.f, 1.f)}},
      .depth = {ports.depth.get()},
  });
  rendering.buffer("ViewBlock", ports.view->block);
  rendering.buffer("LightBlock", ports.lights->block);
  render::bindGBuffer(rendering, ports);
  render::bindShadowMaps(rendering, ports.shadowMaps ? *ports.shadowMaps : noMaps_,
                         params.filter != Filter::Nearest);
  if (ports.ambientVisibility)
    rendering.texture("ambientVisibility", *ports.ambientVisibility, gpu::kNearest);

  const int radius = std::max(static_cast<int>(params.filter) - 1, 0);
  const auto draw = [&](const Programs& programs, gpu::Blend blend) {
    const gpu::ProgramPtr& program = ports.ambientVisibility ? programs.occluded : programs.plain;
    // At depth 0: passes where something nearer was drawn, so that empty pixels cost nothing.
    rendering.use(*program, {.depthTest = true,
                             .depthCompare = gpu::Compare::Less,
                             .blend = blend,
                             .cull = gpu::Cull::None});
    program->set("ambientScale", params.ambient);
    program->set("shadowFilterRadius", radius);
    program->set("shadowFilterReach",
                 params.filter == Filter::Nearest ? 0.5f : static_cast<float>(radius) + 1.f);
    program->set("shadowBias", params.bias);
    program->set("shadowNormalBias", params.normalBias);
    rendering.fullscreen();
  };
  const bool anyCustom =
      std::ranges::any_of(ports.scene->scene->materials,
                          [](const scene::Material& material) { return material.shader.used(); });
  if (anyCustom && !ports.color.isNew()) draw(darkening_, gpu::Blend::Multiply);
  draw(lighting_, gpu::Blend::Off);
}

}  // namespace lucerna::passes
