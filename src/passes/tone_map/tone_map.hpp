// ToneMap: from linear radiance to the values that a screen or PNG takes.
#pragma once

#include "graph/pass_info.hpp"
#include "render/gpu_scene.hpp"

namespace lucerna::passes {

class ToneMap {
 public:
  enum class Operator { Filmic, Reinhard, Linear, None };
  struct Params {
    Operator curve = Operator::Filmic;
    float exposure = 0.f;
  };
  struct Ports {
    graph::In<render::GpuScene> scene;
    graph::In<gpu::Texture> input;
    graph::Out<gpu::Texture> output;
  };

  static void describe(graph::PassInfo<Params, Ports>& d);
  explicit ToneMap(gpu::Device& device);
  void execute(graph::PassContext& context, const Params& params, const Ports& ports);

 private:
  gpu::ProgramPtr program_;
};

}  // namespace lucerna::passes
