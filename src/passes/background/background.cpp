#include "passes/background/background.hpp"

namespace lucerna::passes {

using gpu::Format;

void Background::describe(graph::PassInfo<Params, Ports>& d) {
  d.pass("Background", "Shows the scene's background where nothing was drawn.");
  d.param("intensity", &Params::intensity)
      .range(0, 1000)
      .help("Factor on the background's radiance.");
  d.read("scene", &Ports::scene).help("Its background: a colour, a flat picture or a cube map.");
  d.read("view", &Ports::view).help("Where the eye looks, for cube maps.");
  d.read("depth", &Ports::depth)
      .texture(Format::Depth32F)
      .help("Reversed depth: the background shows where it is 0.");
  d.update("color", &Ports::color)
      .texture(Format::Rgba16Float)
      .sameSizeAs("depth")
      .help("Linear radiance.");
}

void Background::execute(graph::PassContext& context, const Params& params, const Ports& ports) {
  gpu::Rendering rendering =
      context.device.render({.colors = {{ports.color.get()}}, .depth = {ports.depth.get()}});
  // At the far plane, depth 0: equal only where nothing was drawn.
  shading_.draw(rendering, *ports.scene, *ports.view, params.intensity,
                {.depthTest = true, .depthCompare = gpu::Compare::Equal, .cull = gpu::Cull::None});
}

}  // namespace lucerna::passes
