// Cull: which objects this view can see, in four sorted lists.
#pragma once

#include <vector>

#include "graph/pass_info.hpp"
#include "render/draw_list.hpp"
#include "render/view_data.hpp"

namespace lucerna::passes {

class Cull {
 public:
  struct Params {
    bool frustum = true;
    bool sort = true;
  };
  struct Ports {
    graph::In<render::GpuScene> scene;
    graph::In<render::ViewData> view;
    graph::Out<render::DrawLists> drawLists;
  };

  static void describe(graph::PassInfo<Params, Ports>& d);
  explicit Cull(gpu::Device&) {}
  void execute(graph::PassContext& context, const Params& params, const Ports& ports);

 private:
  std::vector<std::uint32_t> visible_;  // kept for its memory
};

}  // namespace lucerna::passes
