// Transparency: translucent objects, back to front, over what is there.
#pragma once

#include "graph/pass_info.hpp"
#include "render/forward_shading.hpp"

namespace lucerna::passes {

class Transparency {
 public:
  struct Params {
    float ambient = 1.f;
    bool backFaces = false;
  };
  struct Ports {
    graph::In<render::GpuScene> scene;
    graph::In<render::ViewData> view;
    graph::In<render::LightList> lights;
    graph::In<render::Lightmaps> lightmaps;
    graph::In<render::DrawLists> drawLists;
    graph::In<gpu::Texture> depth;
    graph::InOut<gpu::Texture> color;
  };

  static void describe(graph::PassInfo<Params, Ports>& d);
  explicit Transparency(gpu::Device& device) : shading_(device, {{"TRANSPARENT", "1"}}) {}
  void execute(graph::PassContext& context, const Params& params, const Ports& ports);

 private:
  render::ForwardShading shading_;
};

}  // namespace lucerna::passes
