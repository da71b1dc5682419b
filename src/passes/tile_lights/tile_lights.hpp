// TileLights: which lights may reach each tile of 16 x 16 pixels.
#pragma once

#include "graph/pass_info.hpp"
#include "render/light_list.hpp"
#include "render/tile_lights.hpp"
#include "render/view_data.hpp"

namespace lucerna::passes {

class TileLights {
 public:
  struct Params {};
  struct Ports {
    graph::In<render::ViewData> view;
    graph::In<render::LightList> lights;
    graph::In<gpu::Texture> depth, normal;
    graph::Out<render::TileLights> tileLights;
  };

  static void describe(graph::PassInfo<Params, Ports>& d);
  explicit TileLights(gpu::Device& device);
  void execute(graph::PassContext& context, const Params& params, const Ports& ports);

 private:
  gpu::ProgramPtr program_, facingProgram_;  // without normals, with them
};

}  // namespace lucerna::passes
