// GBuffer: geometry and materials of what is seen first, for passes that shade later.
#pragma once

#include "graph/pass_info.hpp"
#include "render/draw_list.hpp"
#include "render/lightmaps.hpp"
#include "render/object_programs.hpp"
#include "render/view_data.hpp"

namespace lucerna::passes {

class GBuffer {
 public:
  struct Params {
    bool backFaces = false;
    bool baked = false;
  };
  struct Ports {
    graph::In<render::GpuScene> scene;
    graph::In<render::ViewData> view;
    graph::In<render::DrawLists> drawLists;
    graph::In<render::Lightmaps> lightmaps;
    graph::Out<gpu::Texture> depth, normal, albedo, specular, material, emissive, bakedIrradiance;
  };

  static void describe(graph::PassInfo<Params, Ports>& d);
  explicit GBuffer(gpu::Device& device) : programs_(device, "passes/gbuffer/gbuffer.frag") {}
  void execute(graph::PassContext& context, const Params& params, const Ports& ports);

 private:
  // Whether the target for baked light is drawn to; if it cannot be, it is made black.
  bool bakes(gpu::Device& device, const Ports& ports);

  render::ObjectPrograms programs_;
  bool warned_ = false;
};

}  // namespace lucerna::passes
