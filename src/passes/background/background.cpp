#include "passes/background/background.hpp"

namespace lucerna::passes {
namespace {

gpu::ProgramPtr programFor(gpu::Device& device, const char* kind) {
  return device.program({.vertex = "gpu/fullscreen.vert",
                         .fragment = "passes/background/background.frag",
                         .defines = {{kind, "1"}}});
}

}  // namespace

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

Background::Background(gpu::Device& device)
    : color_(programFor(device, "COLOR")),
      image_(programFor(device, "IMAGE")),
      cubeMap_(programFor(device, "CUBE_MAP")) {}

void Background::execute(graph::PassContext& context, const Params& params, const Ports& ports) {
  const render::GpuScene& gpuScene = *ports.scene;
  const scene::Background& background = gpuScene.scene->background;
  const bool image = background.kind == scene::BackgroundKind::Image;
  const bool cubeMap = background.kind == scene::BackgroundKind::CubeMap;
  const gpu::Program& program = cubeMap ? *cubeMap_ : image ? *image_ : *color_;

  gpu::Rendering rendering =
      context.device.render({.colors = {{ports.color.get()}}, .depth = {ports.depth.get()}});
  // The triangle lies at the far plane, depth 0: equal only where nothing was drawn.
  rendering.use(program,
                {.depthTest = true, .depthCompare = gpu::Compare::Equal, .cull = gpu::Cull::None});
  const float intensity = params.intensity * (image || cubeMap ? background.intensity : 1.f);
  rendering.buffer("ViewBlock", ports.view->block);
  program.set("radiance", intensity * (image || cubeMap ? vec3(1.f) : background.color));
  if (image) {
    // Of two eyes each sees a little beyond one of its edges.
    const gpu::Sampler sampler{.filter = gpu::Filter::Trilinear, .u = gpu::Address::MirroredRepeat};
    rendering.texture("image", gpuScene.textures[background.texture], sampler);
  }
  if (cubeMap) {
    rendering.texture("cubeMap", gpuScene.textures[background.texture],
                      {.filter = gpu::Filter::Trilinear});
  }
  rendering.fullscreen();
}

}  // namespace lucerna::passes
