#include "vignette.hpp"

using namespace lucerna;

namespace {

constexpr gpu::EmbeddedShader kShaders[] = {{"vignette/vignette.frag", R"glsl(
#include "render/view.glsl"

uniform sampler2D color;
uniform float strength;

layout(location = 0) out vec4 darkened;

void main() {
  // From the centre of the whole picture, of which this may be a tile; 1 at its corners.
  vec2 position = ndcOfPixel(gl_FragCoord.xy) * normalize(view.size.xy);
  vec4 radiance = texelFetch(color, ivec2(gl_FragCoord.xy), 0);
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
  d.read("view", &Ports::view).help("Where in the picture a pixel lies.");
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
  rendering.buffer("ViewBlock", ports.view->block);
  program_->set("strength", params.strength);
  rendering.texture("color", *ports.input, gpu::kNearest);
  rendering.fullscreen();
}
