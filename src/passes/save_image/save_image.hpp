// SaveImage: writes any texture to a picture file, at the row's place in the list.
#pragma once

#include "graph/pass_info.hpp"

namespace lucerna::passes {

class SaveImage {
 public:
  struct Params {
    std::string file = "image-%04d.png";
  };
  struct Ports {
    graph::In<gpu::Texture> color;
  };

  static void describe(graph::PassInfo<Params, Ports>& d);
  explicit SaveImage(gpu::Device&) {}
  void execute(graph::PassContext& context, const Params& params, const Ports& ports);
};

}  // namespace lucerna::passes
