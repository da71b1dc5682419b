// Penumbra: how wide penumbrae are, for each layer of screen-space shadows, at half the size.
#pragma once

#include <map>

#include "render/layer_lookup.hpp"
#include "render/layered_shadows.hpp"

namespace lucerna::passes {

class Penumbra {
 public:
  struct Params : render::LayerLookupParams {
    int search = 5;  // depths along each side, odd
  };
  struct Ports : render::LayerLookupPorts {
    graph::Out<render::Penumbrae> penumbrae;
  };

  static void describe(graph::PassInfo<Params, Ports>& d);
  explicit Penumbra(gpu::Device& device) : device_(device) {}
  void execute(graph::PassContext& context, const Params& params, const Ports& ports);

 private:
  const gpu::Program& programOf(const Ports& ports, int arrayLayers);

  gpu::Device& device_;
  std::map<gpu::ProgramDesc, gpu::ProgramPtr> programs_;
};

}  // namespace lucerna::passes
