// ShadowMask: for each pixel a bit for each layer, set where the layer's light is blocked.
#pragma once

#include <map>

#include "render/layer_lookup.hpp"

namespace lucerna::passes {

class ShadowMask {
 public:
  struct Params : render::LayerLookupParams {
    render::LayeredVariant variant = render::LayeredVariant::Mended;
  };
  struct Ports : render::LayerLookupPorts {
    graph::Out<gpu::Texture> shadowMask;
  };

  static void describe(graph::PassInfo<Params, Ports>& d);
  explicit ShadowMask(gpu::Device& device) : device_(device) {}
  void execute(graph::PassContext& context, const Params& params, const Ports& ports);

 private:
  const gpu::Program& programOf(const Params& params, const Ports& ports);

  gpu::Device& device_;
  std::map<gpu::ProgramDesc, gpu::ProgramPtr> programs_;
};

}  // namespace lucerna::passes
