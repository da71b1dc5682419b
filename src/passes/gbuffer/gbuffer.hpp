// GBuffer: geometry and materials of what is seen first, for passes that shade later.
#pragma once

#include "graph/pass_info.hpp"
#include "render/draw_list.hpp"
#include "render/object_programs.hpp"
#include "render/view_data.hpp"

namespace lucerna::passes {

class GBuffer {
 public:
  struct Params {
    bool backFaces = false;
  };
  struct Ports {
    graph::In<render::GpuScene> scene;
    graph::In<render::ViewData> view;
    graph::In<render::DrawLists> drawLists;
    graph::Out<gpu::Texture> depth, normal, albedo, specular, material, emissive;
  };

  static void describe(graph::PassInfo<Params, Ports>& d);
  explicit GBuffer(gpu::Device& device) : programs_(device, "passes/gbuffer/gbuffer.frag") {}
  void execute(graph::PassContext& context, const Params& params, const Ports& ports);

 private:
  render::ObjectPrograms programs_;
};

}  // namespace lucerna::passes
