#include "passes/cull/cull.hpp"

#include <algorithm>
#include <numeric>

namespace lucerna::passes {

void Cull::describe(graph::PassInfo<Params, Ports>& d) {
  d.pass("Cull", "Finds the objects that the view can see and sorts them into draw lists.");
  d.param("frustum", &Params::frustum)
      .help("Leave out objects outside the view frustum; off draws everything.");
  d.param("sort", &Params::sort)
      .help(
          "Sort opaque objects by material, then mesh; off keeps the scene's order. Transparent "
          "objects are always sorted back to front.");
  d.read("scene", &Ports::scene).help("Objects, their boxes and the hierarchy over them.");
  d.read("view", &Ports::view).help("The view whose frustum counts.");
  d.write("drawLists", &Ports::drawLists)
      .help("Opaque, alpha-tested, transparent and mirror objects with their draw commands.");
}

void Cull::execute(graph::PassContext& context, const Params& params, const Ports& ports) {
  const render::GpuScene& gpuScene = *ports.scene;
  visible_.clear();
  if (params.frustum) {
    gpuScene.bvh.query(ports.view->frustumW(), visible_);
    if (!params.sort) std::ranges::sort(visible_);
  } else {
    visible_.resize(gpuScene.scene->objects.size());
    std::iota(visible_.begin(), visible_.end(), 0u);
  }
  makeLists(context.device, gpuScene, ports.view->view, visible_, params.sort, *ports.drawLists);
}

}  // namespace lucerna::passes
