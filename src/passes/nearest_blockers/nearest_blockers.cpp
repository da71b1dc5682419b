#include "passes/nearest_blockers/nearest_blockers.hpp"

namespace lucerna::passes {

using gpu::Format;

void NearestBlockers::describe(graph::PassInfo<Params, Ports>& d) {
  d.pass("NearestBlockers",
         "Reduces shadow maps to what is nearest to the light in blocks of 8 x 8 texels and more.");
  d.runs(graph::Frequency::PerViewGroup);
  d.needs(gpu::kFeatureCompute);
  d.read("shadowMaps", &Ports::shadowMaps).help("What each light sees.");
  d.write("nearestBlockers", &Ports::nearestBlockers)
      .help("Small copies of the maps, kept as long as those are.");
}

NearestBlockers::NearestBlockers(gpu::Device& device) {
  gpu::ProgramDesc desc{.compute = "passes/nearest_blockers/nearest_blockers.comp"};
  ofBlocks_ = device.program(desc);
  desc.defines["OF_MAPS"] = "1";
  ofMaps_ = device.program(desc);
}

void NearestBlockers::reduce(gpu::Device& device, const gpu::Texture& maps, gpu::Texture& nearest) {
  const auto blocks = [](int texels) {
    return std::max(texels / render::NearestBlockers::kBlock, 1);
  };
  const gpu::TextureDesc desc{.kind = gpu::TextureKind::Array2D,
                              .format = Format::R32Float,
                              .width = blocks(maps.width()),
                              .height = blocks(maps.height()),
                              .layers = maps.desc().layers,
                              .levels = 0};
  if (!nearest || nearest.width() != desc.width || nearest.desc().layers != desc.layers)
    nearest = device.createTexture(desc, "nearest blockers");
  for (int level = 0; level < nearest.desc().levels; ++level) {
    {
      gpu::Computing computing = device.compute();
      const gpu::Program& program = level == 0 ? *ofMaps_ : *ofBlocks_;
      computing.use(program);
      computing.texture("from", level == 0 ? maps : nearest, gpu::kNearest);
      computing.image("to", nearest, level);
      program.set("level", level);
      const auto texels = [&](int ofLevel0) {
        return static_cast<std::uint32_t>(std::max(ofLevel0 >> level, 1));
      };
      computing.dispatch((texels(nearest.width()) + 63) / 64, texels(nearest.height()),
                         static_cast<std::uint32_t>(nearest.desc().layers));
    }
    device.barrier();
  }
}

void NearestBlockers::execute(graph::PassContext& context, const Params&, const Ports& ports) {
  const render::ShadowMaps& maps = *ports.shadowMaps;
  render::NearestBlockers& out = *ports.nearestBlockers;
  // Kept maps may come to see panes again without being drawn.
  const bool hasPanes = static_cast<bool>(out.localPanes);
  if (maps.revision == revision_ && maps.seesPanes() == hasPanes) return;
  revision_ = maps.revision;
  reduce(context.device, maps.directional, out.directional);
  reduce(context.device, maps.local, out.local);
  if (maps.seesPanes()) {
    reduce(context.device, maps.directionalPanes.depth, out.directionalPanes);
    reduce(context.device, maps.localPanes.depth, out.localPanes);
  } else {
    out.directionalPanes = {};
    out.localPanes = {};
  }
}

}  // namespace lucerna::passes
