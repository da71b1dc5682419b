#include "passes/sraa/sraa.hpp"

#include <cmath>

namespace lucerna::passes {

using gpu::Format;

void Sraa::describe(graph::PassInfo<Params, Ports>& d) {
  d.pass("Sraa", "Smooths the edges of surfaces by geometry that is sampled within pixels.");
  d.param("sharpness", &Params::sharpness)
      .range(0.1, 1000)
      .help(
          "How fast a pixel's weight falls with its distance from a sample, in doublings of a "
          "pixel's size, or its angle to it in radians: exp(-sharpness * the greater).");
  d.read("scene", &Ports::scene).help("Its exposure, for weighing radiance.");
  d.read("view", &Ports::view).help("The view that all was drawn from.");
  d.read("depth", &Ports::depth)
      .texture(Format::Depth32F)
      .halo(1)
      .help("Reversed depth of what was shaded.");
  d.read("normal", &Ports::normal)
      .texture(Format::Rg16Unorm)
      .sameSizeAs("depth")
      .optional()
      .halo(1)
      .help("View-space normal, octahedral; read only if there are normalSamples.");
  d.read("depthSamples", &Ports::depthSamples)
      .spec(gpu::TextureKind::Multisample2D, {Format::Depth32F})
      .samples(4)
      .sameSizeAs("depth")
      .halo(1)
      .help("Reversed depth at places within each pixel.");
  d.read("normalSamples", &Ports::normalSamples)
      .spec(gpu::TextureKind::Multisample2D, {Format::Rg16Unorm})
      .samples(4)
      .sameSizeAs("depth")
      .optional()
      .help("Normals there. Without them depth alone tells surfaces apart.");
  d.update("color", &Ports::color)
      .texture(Format::Rgba16Float, Format::Rgba8Unorm)
      .sameSizeAs("depth")
      .halo(1)
      .help("The picture: linear radiance, or as ToneMap encodes it.");
}

Sraa::Sraa(gpu::Device& device) {
  gpu::ProgramDesc desc{.vertex = "gpu/fullscreen.vert", .fragment = "passes/sraa/sraa.frag"};
  depthProgram_ = device.program(desc);
  desc.defines["NORMALS"] = "1";
  normalProgram_ = device.program(desc);
}

// The pass reads beside the pixel that it writes.
const gpu::Texture& Sraa::copyOf(gpu::Device& device, const gpu::Texture& color) {
  if (!before_ || before_.desc() != color.desc())
    before_ = device.createTexture(color.desc(), "Sraa before");
  device.copy(color, before_);
  return before_;
}

// The plane through depth at a pixel's centre that fits its samples best, by least squares: its
// gradient g is the sum of fit * (depth of the sample - depth at the centre), as the derivative of
// the sum of (g . o - difference)^2 over offsets o is 0 for g = (sum of o o^T)^-1 (sum of o *
// difference).
void Sraa::placeSamples(gpu::Device& device, const gpu::Texture& samples) {
  const std::vector<vec2> positions = device.samplePositions(samples);
  CHECK(positions.size() == 4, "'{}' has {} samples a pixel; Sraa reads 4", samples.label(),
        positions.size());
  glm::mat2 squares(0.f);
  for (const vec2& position : positions)
    squares += glm::outerProduct(position - 0.5f, position - 0.5f);
  const glm::mat2 inverse = glm::inverse(squares);
  for (int i = 0; i < 4; ++i) {
    const vec2 place = positions[static_cast<std::size_t>(i)] - 0.5f, fit = inverse * place;
    for (int axis = 0; axis < 2; ++axis) {
      places_[axis][i] = place[axis];
      fit_[axis][i] = fit[axis];
    }
  }
  placed_ = true;
}

void Sraa::execute(graph::PassContext& context, const Params& params, const Ports& ports) {
  const gpu::Texture& before = copyOf(context.device, *ports.color);
  if (!placed_) placeSamples(context.device, *ports.depthSamples);
  const bool normals = ports.normal && ports.normalSamples;
  const gpu::ProgramPtr& program = normals ? normalProgram_ : depthProgram_;
  gpu::Rendering rendering = context.device.render({.colors = {{ports.color.get()}}, .depth = {}});
  rendering.use(*program, {.cull = gpu::Cull::None});
  const bool encoded = ports.color->format() == Format::Rgba8Unorm;
  program->set("sharpness", params.sharpness);
  program->set("placesX", places_[0]);
  program->set("placesY", places_[1]);
  program->set("fitX", fit_[0]);
  program->set("fitY", fit_[1]);
  program->set("encoded", encoded);
  program->set("exposure", std::exp2(ports.scene->scene->exposure));
  rendering.buffer("ViewBlock", ports.view->block);
  rendering.texture("color", before, gpu::kNearest);
  rendering.texture("depth", *ports.depth, gpu::kNearest);
  rendering.texture("depthSamples", *ports.depthSamples, gpu::kNearest);
  if (normals) {
    rendering.texture("normal", *ports.normal, gpu::kNearest);
    rendering.texture("normalSamples", *ports.normalSamples, gpu::kNearest);
  }
  rendering.fullscreen();
}

}  // namespace lucerna::passes
