// Lighting: shades the G-buffer with all lights, one full-screen draw.
#pragma once

#include "render/gbuffer_inputs.hpp"
#include "render/light_list.hpp"
#include "render/view_data.hpp"

namespace lucerna::passes {

class Lighting {
 public:
  struct Params {
    float ambient = 1.f;
  };
  struct Ports : render::GBufferInputs {
    graph::In<render::ViewData> view;
    graph::In<render::LightList> lights;
    graph::In<gpu::Texture> ambientVisibility;
    graph::InOut<gpu::Texture> color;
  };

  static void describe(graph::PassInfo<Params, Ports>& d);
  explicit Lighting(gpu::Device& device);
  void execute(graph::PassContext& context, const Params& params, const Ports& ports);

 private:
  gpu::ProgramPtr program_, occludedProgram_;  // without and with ambientVisibility
};

}  // namespace lucerna::passes
