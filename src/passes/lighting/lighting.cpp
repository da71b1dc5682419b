#include "passes/lighting/lighting.hpp"

namespace lucerna::passes {

void Lighting::describe(graph::PassInfo<Params, Ports>& d) {
  d.pass("Lighting", "Shades the G-buffer with the ambient light and all lights.");
  d.param("ambient", &Params::ambient).range(0, 100).help("Factor on the scene's ambient light.");
  describeDeferred(d, 0,
                   "Linear radiance, emission included. Pixels of custom shaders and those where "
                   "nothing was drawn stay as they were; black if nothing was there.");
}

void Lighting::execute(graph::PassContext& context, const Params& params, const Ports& ports) {
  gpu::Rendering rendering = beginDeferred(context.device, ports);
  const gpu::Program& program = program_.of(ports);
  rendering.use(program, render::deferredState());
  program.set("ambientScale", params.ambient);
  rendering.fullscreen();
}

}  // namespace lucerna::passes
