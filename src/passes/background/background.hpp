// Background: fills the pixels where nothing was drawn.
#pragma once

#include "graph/pass_info.hpp"
#include "render/background_shading.hpp"

namespace lucerna::passes {

class Background {
 public:
  struct Params {
    float intensity = 1.f;
  };
  struct Ports {
    graph::In<render::GpuScene> scene;
    graph::In<render::ViewData> view;
    graph::In<gpu::Texture> depth;
    graph::InOut<gpu::Texture> color;
  };

  static void describe(graph::PassInfo<Params, Ports>& d);
  explicit Background(gpu::Device& device) : shading_(device) {}
  void execute(graph::PassContext& context, const Params& params, const Ports& ports);

 private:
  render::BackgroundShading shading_;
};

}  // namespace lucerna::passes
