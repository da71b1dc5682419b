#include "passes/lighting/lighting.hpp"

namespace lucerna::passes {

using gpu::Format;

void Lighting::describe(graph::PassInfo<Params, Ports>& d) {
  d.pass("Lighting", "Shades the G-buffer with the ambient light and all lights.");
  d.param("ambient", &Params::ambient).range(0, 100).help("Factor on the scene's ambient light.");
  d.read("view", &Ports::view).help("The view that the G-buffer was drawn from.");
  d.read("lights", &Ports::lights).help("Lights that are on, and the ambient light.");
  render::readGBuffer(d);
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
          "Linear radiance, emission included. Pixels of custom shaders and those where nothing "
          "was drawn stay as they were; black if nothing was there.");
}

Lighting::Lighting(gpu::Device& device) {
  gpu::ProgramDesc desc{.vertex = "gpu/fullscreen.vert",
                        .fragment = "passes/lighting/lighting.frag"};
  program_ = device.program(desc);
  desc.defines["AMBIENT_VISIBILITY"] = "1";
  occludedProgram_ = device.program(desc);
}

void Lighting::execute(graph::PassContext& context, const Params& params, const Ports& ports) {
  gpu::Rendering rendering = context.device.render({
      .colors = {{ports.color.get(), ports.color.isNew() ? gpu::Load::Clear : gpu::Load::Keep,
                  vec4(0.f, 0.f, 0.f, 1.f)}},
      .depth = {ports.depth.get()},
  });
  // The triangle lies at depth 0: it passes where something nearer was drawn, so that empty pixels
  // cost nothing. Depth is tested and read, never written.
  const gpu::ProgramPtr& program = ports.ambientVisibility ? occludedProgram_ : program_;
  rendering.use(*program,
                {.depthTest = true, .depthCompare = gpu::Compare::Less, .cull = gpu::Cull::None});
  program->set("ambientScale", params.ambient);
  rendering.buffer("ViewBlock", ports.view->block);
  rendering.buffer("LightBlock", ports.lights->block);
  render::bindGBuffer(rendering, ports);
  if (ports.ambientVisibility)
    rendering.texture("ambientVisibility", *ports.ambientVisibility, gpu::kNearest);
  rendering.fullscreen();
}

}  // namespace lucerna::passes
