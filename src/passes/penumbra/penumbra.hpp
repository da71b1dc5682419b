// Penumbra: how wide penumbrae are, for each layer of screen-space shadows.
#pragma once

#include <map>

#include "render/layer_widths.hpp"
#include "render/layered_shadows.hpp"

namespace lucerna::passes {

class Penumbra {
 public:
  using Method = render::LayerWidthParams::Method;
  struct Params : render::LayerLookupParams, render::LayerWidthParams {
    render::LayerResolution resolution = render::LayerResolution::Half;
    render::LayeredVariant variant = render::LayeredVariant::Mended;
  };
  struct Ports : render::LayerWidthPorts {
    graph::Out<render::Penumbrae> penumbrae;
  };

  static void describe(graph::PassInfo<Params, Ports>& d);
  explicit Penumbra(gpu::Device& device) : device_(device) {}
  void execute(graph::PassContext& context, const Params& params, const Ports& ports);

 private:
  const gpu::Program& programOf(const Ports& ports);

  gpu::Device& device_;
  std::map<gpu::ProgramDesc, gpu::ProgramPtr> programs_;
};

}  // namespace lucerna::passes
