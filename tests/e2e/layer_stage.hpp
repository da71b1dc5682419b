// What tests share of passes that look pixels up in shadow maps, executed one by one.
#pragma once

#include "half_plane.hpp"
#include "passes/shadow_layers/shadow_layers.hpp"
#include "render/layer_lookup.hpp"

namespace lucerna::testing {

// The scene's G-buffer, the maps of its lights and their layers.
class LayerStage {
 public:
  LayerStage(const scene::Scene& scene, uvec2 size, const passes::ShadowMaps::Params& mapParams,
             const passes::ShadowLayers::Params& layerParams = {})
      : renderer(scene) {
    auto output = renderer.render(rows({"Cull", "GBuffer", "TiledLighting"}), size,
                                  {"GBuffer.depth", "GBuffer.normal"});
    CHECK(static_cast<bool>(output), "{}", output.error().message);
    depth = uploaded(output->kept.at("GBuffer.depth"), gpu::Format::Depth32F);
    normal = uploaded(output->kept.at("GBuffer.normal"), gpu::Format::Rg16Unorm);
    maps = mapsFor(renderer, mapParams);
    graph::PassContext context{.device = device()};
    passes::ShadowLayers::Ports ports;
    ports.scene.bind(&renderer.gpuScene);
    ports.lights.bind(&renderer.lights);
    ports.shadowMaps.bind(&maps);
    ports.shadowLayers.bind(&layers);
    passes::ShadowLayers(device()).execute(context, layerParams, ports);
  }

  // All but the lists of tiles: each pixel tries all lights.
  void bind(render::LayerLookupPorts& ports) const {
    ports.view.bind(&renderer.view);
    ports.lights.bind(&renderer.lights);
    ports.shadowMaps.bind(&maps);
    ports.shadowLayers.bind(&layers);
    ports.depth.bind(&depth);
    ports.normal.bind(&normal);
  }

  SceneRenderer renderer;
  gpu::Texture depth, normal;
  render::ShadowMaps maps;
  render::ShadowLayers layers;
};

}  // namespace lucerna::testing
