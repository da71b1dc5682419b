// Sraa: smooth edges from the picture as it is shaded once a pixel and geometry sampled more often.
// Chajdas, McGuire and Luebke, "Subpixel Reconstruction Antialiasing for Deferred Shading", I3D
// 2011.
#pragma once

#include <array>

#include "graph/pass_info.hpp"
#include "render/gpu_scene.hpp"
#include "render/view_data.hpp"

namespace lucerna::passes {

class Sraa {
 public:
  struct Params {
    float sharpness = 8.f;
  };
  struct Ports {
    graph::In<render::GpuScene> scene;
    graph::In<render::ViewData> view;
    graph::In<gpu::Texture> depth, normal, depthSamples, normalSamples;
    graph::InOut<gpu::Texture> color;
  };

  static void describe(graph::PassInfo<Params, Ports>& d);
  explicit Sraa(gpu::Device& device);
  void execute(graph::PassContext& context, const Params& params, const Ports& ports);

 private:
  const gpu::Texture& copyOf(gpu::Device& device, const gpu::Texture& color);
  void placeSamples(gpu::Device& device, const gpu::Texture& samples);

  gpu::ProgramPtr depthProgram_, normalProgram_;
  gpu::Texture before_;  // the picture that is smoothed
  // Of the four samples, along x and along y: px from the pixel's centre; part in the gradient.
  std::array<vec4, 2> places_{}, fit_{};
  bool placed_ = false;
};

}  // namespace lucerna::passes
