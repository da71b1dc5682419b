#include "passes/shadow_tiles/shadow_tiles.hpp"

namespace lucerna::passes {

using gpu::Format;

void ShadowTiles::describe(graph::PassInfo<Params, Ports>& d) {
  d.pass(
      "ShadowTiles",
      "Finds the lights that are partly blocked in or near each tile: nothing else has penumbrae.");
  d.needs(gpu::kFeatureCompute);
  d.param("reach", &Params::reach)
      .range(0, 512)
      .unit("px")
      .help("How far from a tile is near: as far as ShadowBlur reaches.");
  d.read("lights", &Ports::lights).help("Lights that are on.");
  d.read("tileLights", &Ports::tileLights)
      .optional()
      .help("Which lights may reach a tile; without it none is left out.");
  d.read("shadowLayers", &Ports::shadowLayers)
      .optional()
      .help("The layer of each light; without it none is left out.");
  d.read("shadowMask", &Ports::shadowMask)
      .texture(Format::R32Uint)
      .sameSizeAs("depth")
      .help("Hard shadows.");
  d.read("shadowValues", &Ports::shadowValues)
      .optional()
      .help(
          "Bytes of each layer, in place of the mask's bits: what is dark in part has penumbrae.");
  d.read("depth", &Ports::depth)
      .texture(Format::Depth32F)
      .help("Reversed depth: pixels where nothing was drawn do not count.");
  d.write("partlyLit", &Ports::partlyLit)
      .help(
          "Of the lights of each tile that have a layer, those that are blocked at some of its "
          "pixels and those around and not at others.");
}

ShadowTiles::ShadowTiles(gpu::Device& device)
    : bitsProgram_(device.program({.compute = "passes/shadow_tiles/tile_bits.comp"})),
      valuesProgram_(device.program(
          {.compute = "passes/shadow_tiles/tile_bits.comp", .defines = {{"SHADOW_VALUES", "1"}}})),
      lightsProgram_(device.program({.compute = "passes/shadow_tiles/partly_lit.comp"})) {}

void ShadowTiles::execute(graph::PassContext& context, const Params& params, const Ports& ports) {
  gpu::Device& device = context.device;
  render::TileLights& out = *ports.partlyLit;
  if (!ports.tileLights || !ports.shadowLayers) {
    out = {};
    return;
  }
  out.tiles = ports.tileLights->tiles;
  const std::size_t bytes = ports.tileLights->block.bytes();
  if (!out.block || out.block.bytes() < bytes)
    out.block = device.createBuffer(bytes, "TileLightBlock of partly lit");
  const std::size_t bitBytes = std::size_t(out.tiles) * 8;
  if (!tileBits_ || tileBits_.bytes() < bitBytes)
    tileBits_ = device.createBuffer(bitBytes, "TileBitBlock");
  const auto tiles = [](int pixels) {
    return static_cast<std::uint32_t>((pixels + render::kLightTile - 1) / render::kLightTile);
  };
  {
    gpu::Computing computing = device.compute();
    const bool byValues = ports.shadowValues && ports.shadowValues->layers > 0;
    computing.use(byValues ? *valuesProgram_ : *bitsProgram_);
    computing.buffer("TileBitBlock", tileBits_);
    if (byValues) {
      computing.texture("shadowValues", ports.shadowValues->bytes, gpu::kNearest);
      valuesProgram_->set("arrayLayers", ports.shadowValues->bytes.desc().layers);
    } else {
      computing.texture("shadowMask", *ports.shadowMask, gpu::kNearest);
    }
    computing.texture("depth", *ports.depth, gpu::kNearest);
    computing.dispatch(tiles(ports.depth->width()), tiles(ports.depth->height()));
  }
  device.barrier();
  {
    gpu::Computing computing = device.compute();
    computing.use(*lightsProgram_);
    computing.buffer("LightBlock", ports.lights->block);
    computing.buffer("ShadowLayerBlock", ports.shadowLayers->block);
    computing.buffer("TileLightBlock", ports.tileLights->block);
    computing.buffer("TileBitBlock", tileBits_);
    computing.buffer("PartlyLitBlock", out.block);
    lightsProgram_->set("tiles", static_cast<int>(out.tiles));
    lightsProgram_->set("reach", (params.reach + render::kLightTile - 1) / render::kLightTile);
    computing.dispatch((out.tiles + 63) / 64);
  }
  device.barrier();
}

}  // namespace lucerna::passes
