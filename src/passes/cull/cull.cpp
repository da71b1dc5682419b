#include "passes/cull/cull.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

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

void sortForState(const render::GpuScene& gpuScene, std::vector<std::uint32_t>& objects) {
  const auto key = [&](std::uint32_t index) {
    const scene::Object& object = gpuScene.scene->objects[index];
    return std::tuple(object.material, static_cast<bool>(gpuScene.mirrored[index]), object.mesh,
                      index);
  };
  std::ranges::sort(objects, {}, key);
}

void sortBackToFront(const render::GpuScene& gpuScene, const scene::View& view,
                     std::vector<std::uint32_t>& objects) {
  // The eye looks along -z, so the farthest centre has the smallest z.
  const vec4 depthRow(view.viewFromWorld[0].z, view.viewFromWorld[1].z, view.viewFromWorld[2].z,
                      view.viewFromWorld[3].z);
  std::vector<std::pair<float, std::uint32_t>> keyed;
  keyed.reserve(objects.size());
  for (const std::uint32_t index : objects) {
    const vec3 center = gpuScene.scene->objects[index].boundsW.center();
    const float depth = glm::dot(depthRow, vec4(center, 1.f));
    // A box without bounds has no centre: it counts as farthest, for a NaN cannot be sorted.
    keyed.emplace_back(std::isfinite(depth) ? depth : -std::numeric_limits<float>::infinity(),
                       index);
  }
  std::ranges::sort(keyed);
  std::ranges::transform(keyed, objects.begin(), [](const auto& pair) { return pair.second; });
}

void Cull::execute(graph::PassContext& context, const Params& params, const Ports& ports) {
  const render::GpuScene& gpuScene = *ports.scene;
  const scene::Scene& scene = *gpuScene.scene;
  render::DrawLists& lists = *ports.drawLists;
  visible_.clear();
  if (params.frustum) {
    gpuScene.bvh.query(ports.view->frustumW(), visible_);
    if (!params.sort) std::ranges::sort(visible_);
  } else {
    visible_.resize(scene.objects.size());
    std::iota(visible_.begin(), visible_.end(), 0u);
  }

  for (render::DrawList* list : lists.all()) list->objects.clear();
  for (const std::uint32_t index : visible_) {
    const scene::Material& material = scene.materials[scene.objects[index].material];
    if (isMirror(material)) {
      lists.mirrors.objects.push_back(index);
      continue;
    }
    switch (material.alphaMode) {
      case scene::AlphaMode::Opaque:
        lists.opaque.objects.push_back(index);
        break;
      case scene::AlphaMode::Mask:
        lists.alphaTested.objects.push_back(index);
        break;
      case scene::AlphaMode::Blend:
        lists.transparent.objects.push_back(index);
        break;
    }
  }
  lists.tested = static_cast<std::uint32_t>(scene.objects.size());
  lists.visible = static_cast<std::uint32_t>(visible_.size());
  if (params.sort) {
    sortForState(gpuScene, lists.opaque.objects);
    sortForState(gpuScene, lists.alphaTested.objects);
    sortForState(gpuScene, lists.mirrors.objects);
  }
  sortBackToFront(gpuScene, ports.view->view, lists.transparent.objects);
  for (render::DrawList* list : lists.all()) finishList(context.device, gpuScene, *list);
}

}  // namespace lucerna::passes
