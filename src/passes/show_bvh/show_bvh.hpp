// ShowBvh: the boxes of the culling hierarchy as lines over the picture.
#pragma once

#include "graph/pass_info.hpp"
#include "render/gpu_scene.hpp"
#include "render/view_data.hpp"

namespace lucerna::passes {

class ShowBvh {
 public:
  struct Params {
    int level = -1;
    vec3 lineColor{0.1f, 1.f, 0.3f};
    bool hidden = true;
  };
  struct Ports {
    graph::In<render::GpuScene> scene;
    graph::In<render::ViewData> view;
    graph::In<gpu::Texture> depth;
    graph::InOut<gpu::Texture> color;
  };

  static void describe(graph::PassInfo<Params, Ports>& d);
  explicit ShowBvh(gpu::Device& device);
  void execute(graph::PassContext& context, const Params& params, const Ports& ports);

 private:
  gpu::ProgramPtr program_;
  gpu::Buffer boxes_;
  gpu::VertexInput input_;
};

// The boxes of a level (the root is 0) and of leaves above it; of all leaves for level -1.
std::vector<Aabb> boxesOfLevel(const scene::Bvh& bvh, int level);

}  // namespace lucerna::passes
