#include "vignette.hpp"

using namespace lucerna;

namespace {

constexpr gpu::EmbeddedShader kShaders[] = {{"vignette/vignette.frag", R"glsl(
uniform sampler2D color;
uniform float strength;

layout(location = 0) out vec4 darkened;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec2 size = vec2(textureSize(color, 0));
  // From the centre, 1 at the corners.
  vec2 position = (2.0 * gl_FragCoord.xy - size) / length(size);
  vec4 radiance = texelFetch(color, pixel, 0);
  darkened = vec4(radiance.rgb * (1.0 - strength * dot(position, position)), radiance.a);
}
)glsl"}};

}  // namespace

std::span<const gpu::EmbeddedShader> Vignette::shaders() {
  return kShaders;
}

void Vignette::describe(graph::PassInfo<Params, Ports>& d) {
  d.pass("Vignette", "Darkens the picture towards its corners.");
  d.param("strength", &Params::strength).range(0, 1).help("Light that the very corner loses.");
  d.read("color", &Ports::input).texture(gpu::Format::Rgba16Float).help("Linear radiance.");
  d.write("color", &Ports::output)
      .texture(gpu::Format::Rgba16Float)
      .sizeOf("color")
      .passesThrough("color")
      .help("Linear radiance.");
}

Vignette::Vignette(gpu::Device& device)
    : program_(
          device.program({.vertex = "gpu/fullscreen.vert", .fragment = "vignette/vignette.frag"})) {
}

void Vignette::execute(graph::PassContext& context, const Params& params, const Ports& ports) {
  gpu::Rendering rendering =
      context.device.render({.colors = {{ports.output.get(), gpu::Load::Discard}}, .depth = {}});
  rendering.use(*program_, {.cull = gpu::Cull::None});
  program_->set("strength", params.strength);
  rendering.texture("color", *ports.input, gpu::kNearest);
  rendering.fullscreen();
}
