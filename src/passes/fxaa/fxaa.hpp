// Fxaa: smooths the stairs of edges in the finished picture.
#pragma once

#include "gpu/device.hpp"
#include "graph/pass_info.hpp"

namespace lucerna::passes {

class Fxaa {
 public:
  struct Params {
    float threshold = 0.15f;
    float subpixel = 0.25f;
    int search = 12;  // px
  };
  struct Ports {
    graph::In<gpu::Texture> input;
    graph::Out<gpu::Texture> output;
  };

  static void describe(graph::PassInfo<Params, Ports>& d);
  explicit Fxaa(gpu::Device& device);
  void execute(graph::PassContext& context, const Params& params, const Ports& ports);

 private:
  gpu::ProgramPtr program_;
};

}  // namespace lucerna::passes
