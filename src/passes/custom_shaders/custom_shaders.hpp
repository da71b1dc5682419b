// CustomShaders: objects whose material brings a shader of its own, forward, where the G-buffer
// shows them.
#pragma once

#include "graph/pass_info.hpp"
#include "render/forward_shading.hpp"

namespace lucerna::passes {

class CustomShaders {
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
  explicit CustomShaders(gpu::Device& device) : shading_(device) {}
  void execute(graph::PassContext& context, const Params& params, const Ports& ports);

 private:
  render::ForwardShading shading_;
};

}  // namespace lucerna::passes
