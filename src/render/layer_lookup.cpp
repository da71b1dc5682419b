#include "render/layer_lookup.hpp"

namespace lucerna::render {

void bindLayerLookup(gpu::Rendering& rendering, const gpu::Program& program,
                     const LayerLookupParams& params, const LayerLookupPorts& ports, float reach) {
  rendering.buffer("ViewBlock", ports.view->block);
  rendering.buffer("LightBlock", ports.lights->block);
  if (ports.tiled()) rendering.buffer("TileLightBlock", ports.tileLights->block);
  rendering.buffer("ShadowLayerBlock", ports.shadowLayers->block);
  bindShadowMaps(rendering, *ports.shadowMaps, false);
  rendering.texture("depth", *ports.depth, gpu::kNearest);
  rendering.texture("normal", *ports.normal, gpu::kNearest);
  program.set("shadowReach", reach);
  program.set("shadowBias", params.bias);
  program.set("shadowNormalBias", params.normalBias);
}

}  // namespace lucerna::render
