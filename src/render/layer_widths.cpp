#include "render/layer_widths.hpp"

namespace lucerna::render {
namespace {

// Only lights that have penumbrae, where that is known.
LayerLookupPorts lookupOf(const LayerWidthPorts& ports) {
  LayerLookupPorts lookup = ports;
  if (ports.partlyLit && ports.partlyLit->block) lookup.tileLights = ports.partlyLit;
  return lookup;
}

}  // namespace

void defineLayerWidths(gpu::ProgramDesc& desc, const LayerWidthPorts& ports) {
  if (ports.nearestBlockers) desc.defines["NEAREST_BLOCKERS"] = "1";
  if (ports.shadowLayers->shared) desc.defines["SHARED_LAYERS"] = "1";
  if (lookupOf(ports).tiled()) desc.defines["TILE_LIGHTS"] = "1";
}

void bindLayerWidths(gpu::Rendering& rendering, const gpu::Program& program,
                     const LayerLookupParams& params, const LayerWidthPorts& ports,
                     LayeredVariant variant) {
  bindLayerLookup(rendering, program, params, lookupOf(ports), kFilteredReach);
  if (ports.nearestBlockers) {
    rendering.texture("directionalNearestBlockers", ports.nearestBlockers->directional,
                      gpu::kNearest);
    rendering.texture("localNearestBlockers", ports.nearestBlockers->local, gpu::kNearest);
  }
  program.set("sizeTwice", variant == LayeredVariant::Published ? 1.f : 0.f);
}

}  // namespace lucerna::render
