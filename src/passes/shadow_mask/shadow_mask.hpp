// ShadowMask: for each pixel a bit for each layer, set where the layer's light is blocked.
#pragma once

#include "render/layer_lookup.hpp"

namespace lucerna::passes {

class ShadowMask {
 public:
  using Params = render::LayerLookupParams;
  struct Ports : render::LayerLookupPorts {
    graph::Out<gpu::Texture> shadowMask;
  };

  static void describe(graph::PassInfo<Params, Ports>& d);
  explicit ShadowMask(gpu::Device& device);
  void execute(graph::PassContext& context, const Params& params, const Ports& ports);

 private:
  gpu::ProgramPtr ofAllLights_, ofTiles_;
};

}  // namespace lucerna::passes
