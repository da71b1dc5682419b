#include "passes/fxaa/fxaa.hpp"

namespace lucerna::passes {

using gpu::Format;

void Fxaa::describe(graph::PassInfo<Params, Ports>& d) {
  d.pass("Fxaa", "Smooths the stairs of edges in the finished picture.");
  d.param("threshold", &Params::threshold)
      .range(0.01, 1)
      .help("Least contrast of an edge, as a share of the brightest of its neighbours.");
  d.param("subpixel", &Params::subpixel)
      .range(0, 1)
      .help("How much of what is thinner than a pixel is spread to its neighbours.");
  d.param("search", &Params::search)
      .range(1, 64)
      .unit("px")
      .help("How far the ends of an edge are looked for, on both sides.");
  d.read("color", &Ports::input)
      .texture(Format::Rgba8Unorm)
      .halo(d.values().search + 2)
      .help("sRGB-encoded, as ToneMap makes it: the eye's contrast counts.");
  d.write("color", &Ports::output)
      .texture(Format::Rgba8Unorm)
      .sizeOf("color")
      .passesThrough("color")
      .help("sRGB-encoded.");
}

Fxaa::Fxaa(gpu::Device& device)
    : program_(
          device.program({.vertex = "gpu/fullscreen.vert", .fragment = "passes/fxaa/fxaa.frag"})) {}

void Fxaa::execute(graph::PassContext& context, const Params& params, const Ports& ports) {
  gpu::Rendering rendering =
      context.device.render({.colors = {{ports.output.get(), gpu::Load::Discard}}, .depth = {}});
  rendering.use(*program_, {.cull = gpu::Cull::None});
  program_->set("threshold", params.threshold);
  program_->set("subpixel", params.subpixel);
  program_->set("search", params.search);
  rendering.texture("color", *ports.input, gpu::kNearest);
  rendering.fullscreen();
}

}  // namespace lucerna::passes
