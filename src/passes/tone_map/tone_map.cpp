#include "passes/tone_map/tone_map.hpp"

#include <cmath>

namespace lucerna::passes {

using gpu::Format;

void ToneMap::describe(graph::PassInfo<Params, Ports>& d) {
  d.pass("ToneMap", "Applies exposure and a tone curve and encodes the picture as sRGB.");
  d.param("operator", &Params::curve)
      .choices({"filmic", "reinhard", "linear", "none"})
      .help(
          "filmic: an S-curve that rolls highlights off (the default); reinhard: x / (1 + x) on "
          "luminance; linear: clipped; none: clipped and not encoded, for data.");
  d.param("exposure", &Params::exposure)
      .range(-20, 20)
      .unit("EV")
      .help("Added to the scene's exposure; one more doubles the brightness.");
  d.read("scene", &Ports::scene).help("For its exposure.");
  d.read("color", &Ports::input)
      .texture(Format::Rgba16Float, Format::Rgba32Float, Format::R11G11B10Float)
      .help("Linear radiance.");
  d.write("color", &Ports::output)
      .texture(Format::Rgba8Unorm)
      .sizeOf("color")
      .passesThrough("color")
      .help("sRGB-encoded values in [0, 1].");
}

ToneMap::ToneMap(gpu::Device& device)
    : program_(device.program(
          {.vertex = "gpu/fullscreen.vert", .fragment = "passes/tone_map/tone_map.frag"})) {}

void ToneMap::execute(graph::PassContext& context, const Params& params, const Ports& ports) {
  gpu::Rendering rendering =
      context.device.render({.colors = {{ports.output.get(), gpu::Load::Discard}}, .depth = {}});
  rendering.use(*program_, {.cull = gpu::Cull::None});
  program_->set("curve", static_cast<int>(params.curve));
  program_->set("scale", std::exp2(ports.scene->scene->exposure + params.exposure));
  rendering.texture("color", *ports.input, gpu::kNearest);
  rendering.fullscreen();
}

}  // namespace lucerna::passes
