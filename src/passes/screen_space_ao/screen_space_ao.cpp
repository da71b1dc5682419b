#include "passes/screen_space_ao/screen_space_ao.hpp"

#include <algorithm>
#include <cmath>

#include "core/random.hpp"

namespace lucerna::passes {

using gpu::Format;

namespace {

constexpr int kMostSamples = 64;
constexpr int kBlurReach = 2;  // px

vec3 directionOf(Random& random) {
  const float z = random.uniform(-1.f, 1.f), angle = random.uniform(0.f, 2.f * kPi);
  const float r = std::sqrt(1.f - z * z);
  return {r * std::cos(angle), r * std::sin(angle), z};
}

// In the unit hemisphere around +z, denser near the centre.
vec3 hemispherePoint(Random& random, float share) {
  vec3 direction = directionOf(random);
  direction.z = std::abs(direction.z);
  return direction * glm::mix(0.05f, 1.f, share * share);
}

// Distances and angles to the normal both normally distributed about it.
vec3 gaussianPoint(Random& random) {
  const auto normal = [&] {  // Box and Muller, 1958
    const float u = 1.f - random.uniform();
    return std::sqrt(-2.f * std::log(u)) * std::cos(2.f * kPi * random.uniform());
  };
  const vec3 p(0.35f * normal(), 0.35f * normal(), std::abs(0.5f * normal()) + 0.02f);
  return p / std::max(glm::length(p), 1.f);
}

}  // namespace

void ScreenSpaceAo::describe(graph::PassInfo<Params, Ports>& d) {
  d.pass("ScreenSpaceAo", "Ambient visibility from the depth and the normals on the screen.");
  d.param("method", &Params::method)
      .choices({"horizon", "hemisphere", "gaussian"})
      .help(
          "horizon: the part of the sky between horizons, found by marching over the depth; "
          "hemisphere: the share of points around the surface that are before it; gaussian: the "
          "same with points about the normal.");
  d.param("radius", &Params::radius)
      .range(1e-3, 1e4)
      .unit("m")
      .help("Farthest occluder that counts.");
  d.param("samples", &Params::samples).range(4, kMostSamples).help("Depths read for a pixel.");
  d.param("blur", &Params::blur)
      .choices({"bilateral", "box", "none"})
      .help("Over four by four pixels: where depths are alike, everywhere, or not at all.");
  d.param("reach", &Params::reach)
      .range(8, 4096)
      .unit("px")
      .rebuilds(graph::Rebuild::Ports)
      .help("Occluders farther away on the screen do not count.");
  d.param("apply", &Params::apply)
      .choices({"lighting", "multiply"})
      .rebuilds(graph::Rebuild::Ports)
      .help(
          "lighting: what shades later dims the ambient light by it; multiply: the row multiplies "
          "the picture that is there, direct light and all.");
  d.read("view", &Ports::view).help("The view that depth and normals were drawn from.");
  d.read("depth", &Ports::depth)
      .texture(Format::Depth32F)
      .halo(d.values().reach + kBlurReach)
      .help("Reversed depth.");
  d.read("normal", &Ports::normal)
      .texture(Format::Rg16Unorm)
      .sameSizeAs("depth")
      .help("View-space normal, octahedral.");
  d.write("ambientVisibility", &Ports::ambientVisibility)
      .texture(Format::R8Unorm)
      .sizeOf("depth")
      .whenDisabled(vec4(1.f))
      .help("1: nothing is near. 1 where nothing was drawn.");
  if (d.values().apply == Apply::Multiply)
    d.update("color", &Ports::color)
        .texture(Format::Rgba16Float, Format::Rgba8Unorm)
        .sameSizeAs("depth")
        .help("The finished picture, multiplied as it is stored.");
}

ScreenSpaceAo::ScreenSpaceAo(gpu::Device& device) {
  for (std::size_t i = 0; i < programs_.size(); ++i) {
    const bool horizon = i == static_cast<std::size_t>(Method::Horizon);
    programs_[i] = device.program({.vertex = "gpu/fullscreen.vert",
                                   .fragment = horizon ? "passes/screen_space_ao/horizon.frag"
                                                       : "passes/screen_space_ao/points.frag"});
  }
  blurProgram_ = device.program(
      {.vertex = "gpu/fullscreen.vert", .fragment = "passes/screen_space_ao/blur.frag"});
  multiplyProgram_ = device.program(
      {.vertex = "gpu/fullscreen.vert", .fragment = "passes/screen_space_ao/multiply.frag"});
  // All sixteenths of a turn, so that four by four pixels together look everywhere.
  for (std::size_t i = 0; i < rotations_.size(); ++i) {
    constexpr std::array kOrder{0, 8, 2, 10, 12, 4, 14, 6, 3, 11, 1, 9, 15, 7, 13, 5};
    const float share = static_cast<float>(kOrder[i]) / 16.f, angle = 2.f * kPi * share;
    rotations_[i] = {std::cos(angle), std::sin(angle), share, 0.f};
  }
}

void ScreenSpaceAo::setSamples(const Params& params, std::uint64_t seed) {
  Random random(seed);
  offsets_.clear();
  for (int i = 0; i < params.samples; ++i) {
    const float share = (static_cast<float>(i) + 0.5f) / static_cast<float>(params.samples);
    offsets_.emplace_back(
        params.method == Method::Gaussian ? gaussianPoint(random) : hemispherePoint(random, share),
        0.f);
  }
}

void ScreenSpaceAo::blur(gpu::Device& device, const Params& params, const Ports& ports,
                         const gpu::Texture& from, const gpu::Texture& to, vec2 direction) {
  gpu::Rendering rendering = device.render({.colors = {{&to, gpu::Load::Discard}}, .depth = {}});
  rendering.use(*blurProgram_, {.cull = gpu::Cull::None});
  blurProgram_->set("direction", ivec2(direction));
  blurProgram_->set("bilateral", params.blur == Blur::Bilateral);
  rendering.buffer("ViewBlock", ports.view->block);
  rendering.texture("visibility", from, gpu::kNearest);
  rendering.texture("depth", *ports.depth, gpu::kNearest);
  rendering.fullscreen();
}

void ScreenSpaceAo::multiply(gpu::Device& device, const Ports& ports) {
  gpu::Rendering rendering = device.render({.colors = {{ports.color.get()}}, .depth = {}});
  rendering.use(*multiplyProgram_, {.blend = gpu::Blend::Multiply, .cull = gpu::Cull::None});
  rendering.texture("visibility", *ports.ambientVisibility, gpu::kNearest);
  rendering.fullscreen();
}

void ScreenSpaceAo::execute(graph::PassContext& context, const Params& params, const Ports& ports) {
  gpu::Device& device = context.device;
  const bool blurs = params.blur != Blur::None;
  const gpu::TextureDesc desc{
      .format = Format::R8Unorm, .width = ports.depth->width(), .height = ports.depth->height()};
  for (gpu::Texture& texture : between_)
    if (blurs && (!texture || texture.width() != desc.width || texture.height() != desc.height))
      texture = device.createTexture(desc, "ScreenSpaceAo before its blur");
  {
    const gpu::Texture& target = blurs ? between_[0] : *ports.ambientVisibility;
    gpu::Rendering rendering = device.render(
        {.colors = {{&target, gpu::Load::Clear, vec4(1.f)}}, .depth = {ports.depth.get()}});
    const gpu::ProgramPtr& program = programs_[static_cast<std::size_t>(params.method)];
    // At depth 0: where nothing was drawn it stays 1.
    rendering.use(*program,
                  {.depthTest = true, .depthCompare = gpu::Compare::Less, .cull = gpu::Cull::None});
    program->set("radius", params.radius);
    program->set("reach", static_cast<float>(params.reach));
    program->set("sampleCount", params.samples);
    program->set("rotations", std::span<const vec4>(rotations_));
    if (params.method != Method::Horizon) {
      setSamples(params, context.seed);
      program->set("offsets", std::span<const vec4>(offsets_));
    }
    rendering.buffer("ViewBlock", ports.view->block);
    rendering.texture("depth", *ports.depth, gpu::kNearest);
    rendering.texture("normal", *ports.normal, gpu::kNearest);
    rendering.fullscreen();
  }
  if (blurs) {
    blur(device, params, ports, between_[0], between_[1], {1, 0});
    blur(device, params, ports, between_[1], *ports.ambientVisibility, {0, 1});
  }
  if (params.apply == Apply::Multiply) multiply(device, ports);
}

}  // namespace lucerna::passes
