// Lighting: shades the G-buffer with all lights, one full-screen draw.
#pragma once

#include "render/deferred_shading.hpp"

namespace lucerna::passes {

class Lighting {
 public:
  struct Params {
    float ambient = 1.f;
  };
  using Ports = render::DeferredPorts;

  static void describe(graph::PassInfo<Params, Ports>& d);
  explicit Lighting(gpu::Device& device) : program_(device, "passes/lighting/lighting.frag") {}
  void execute(graph::PassContext& context, const Params& params, const Ports& ports);

 private:
  render::DeferredProgram program_;
};

}  // namespace lucerna::passes
