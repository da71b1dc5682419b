#include "render/background_shading.hpp"

namespace lucerna::render {
namespace {

gpu::ProgramPtr programFor(gpu::Device& device, const char* kind) {
  return device.program({.vertex = "gpu/fullscreen.vert",
                         .fragment = "render/background.frag",
                         .defines = {{kind, "1"}}});
}

}  // namespace

BackgroundShading::BackgroundShading(gpu::Device& device)
    : color_(programFor(device, "COLOR")),
      image_(programFor(device, "IMAGE")),
      cubeMap_(programFor(device, "CUBE_MAP")) {}

void BackgroundShading::draw(gpu::Rendering& rendering, const GpuScene& scene, const ViewData& view,
                             float intensity, const gpu::RenderState& state) {
  const scene::Background& background = scene.scene->background;
  const bool image = background.kind == scene::BackgroundKind::Image;
  const bool cubeMap = background.kind == scene::BackgroundKind::CubeMap;
  const gpu::Program& program = cubeMap ? *cubeMap_ : image ? *image_ : *color_;
  rendering.use(program, state);
  const float factor = intensity * (image || cubeMap ? background.intensity : 1.f);
  rendering.buffer("ViewBlock", view.block);
  program.set("radiance", factor * (image || cubeMap ? vec3(1.f) : background.color));
  if (image) {
    // Of two eyes each sees a little beyond one of its edges.
    const gpu::Sampler sampler{.filter = gpu::Filter::Trilinear, .u = gpu::Address::MirroredRepeat};
    rendering.texture("image", scene.textures[background.texture], sampler);
  }
  if (cubeMap) {
    rendering.texture("cubeMap", scene.textures[background.texture],
                      {.filter = gpu::Filter::Trilinear});
  }
  rendering.fullscreen();
}

}  // namespace lucerna::render
