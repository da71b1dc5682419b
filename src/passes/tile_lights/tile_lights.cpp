#include "passes/tile_lights/tile_lights.hpp"

namespace lucerna::passes {
namespace {

std::uint32_t tilesAcross(int pixels) {
  return static_cast<std::uint32_t>((pixels + render::kLightTile - 1) / render::kLightTile);
}

// TileLightBlock of render/tile_lights.glsl: a header of 16 bytes, a bit for each light in each
// tile. At least one word, for a block of none cannot be bound.
std::size_t bytesFor(std::size_t tiles, std::size_t lights) {
  return 16 + std::max<std::size_t>(tiles * ((lights + 31) / 32), 1) * 4;
}

}  // namespace

void TileLights::describe(graph::PassInfo<Params, Ports>& d) {
  d.pass("TileLights", "Finds the lights that may reach each tile of 16 x 16 pixels.");
  d.needs(gpu::kFeatureCompute);
  d.read("view", &Ports::view).help("The view that depth was drawn from.");
  d.read("lights", &Ports::lights).help("Lights that are on.");
  d.read("depth", &Ports::depth)
      .texture(gpu::Format::Depth32F)
      .help("Reversed depth: lights are kept that reach what is seen in a tile.");
  d.read("normal", &Ports::normal)
      .texture(gpu::Format::Rg16Unorm)
      .sameSizeAs("depth")
      .optional()
      .help("View-space normal, octahedral: surfaces that face away from a light do not count.");
  d.write("tileLights", &Ports::tileLights).help("A bit for each light in each tile.");
}

TileLights::TileLights(gpu::Device& device) {
  gpu::ProgramDesc desc{.compute = "passes/tile_lights/tile_lights.comp"};
  program_ = device.program(desc);
  desc.defines["FACING"] = "1";
  facingProgram_ = device.program(desc);
}

void TileLights::execute(graph::PassContext& context, const Params&, const Ports& ports) {
  gpu::Device& device = context.device;
  const std::uint32_t across = tilesAcross(ports.depth->width()),
                      up = tilesAcross(ports.depth->height());
  ports.tileLights->tiles = across * up;
  gpu::Buffer& block = ports.tileLights->block;
  const std::size_t bytes = bytesFor(std::size_t(across) * up, ports.lights->lights.size());
  if (!block || block.bytes() < bytes) block = device.createBuffer(bytes, "TileLightBlock");
  {
    gpu::Computing computing = device.compute();
    computing.use(ports.normal ? *facingProgram_ : *program_);
    computing.buffer("ViewBlock", ports.view->block);
    computing.buffer("LightBlock", ports.lights->block);
    computing.buffer("TileLightBlock", block);
    computing.texture("depth", *ports.depth, gpu::kNearest);
    if (ports.normal) computing.texture("normal", *ports.normal, gpu::kNearest);
    computing.dispatch(across, up);
  }
  device.barrier();
}

}  // namespace lucerna::passes
