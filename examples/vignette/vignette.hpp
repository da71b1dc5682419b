// Vignette: darkens the picture towards its corners. A pass that is no part of Lucerna.
#pragma once

#include "gpu/device.hpp"
#include "graph/pass_info.hpp"
#include "render/view_data.hpp"

class Vignette {
 public:
  struct Params {
    float strength = 0.7f;
  };
  struct Ports {
    lucerna::graph::In<lucerna::render::ViewData> view;
    lucerna::graph::In<lucerna::gpu::Texture> input;
    lucerna::graph::Out<lucerna::gpu::Texture> output;
  };

  static void describe(lucerna::graph::PassInfo<Params, Ports>& d);
  explicit Vignette(lucerna::gpu::Device& device);
  void execute(lucerna::graph::PassContext& context, const Params& params, const Ports& ports);

  // Texts for the registry.
  static std::span<const lucerna::gpu::EmbeddedShader> shaders();

 private:
  lucerna::gpu::ProgramPtr program_;
};
