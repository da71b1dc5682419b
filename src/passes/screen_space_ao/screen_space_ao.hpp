// ScreenSpaceAo: how much of the light from all around reaches each pixel, from depth and normals.
#pragma once

#include <array>

#include "graph/pass_info.hpp"
#include "render/view_data.hpp"

namespace lucerna::passes {

class ScreenSpaceAo {
 public:
  // Hemisphere and Gaussian are system A's; Horizon is Jimenez et al.'s (README.md).
  enum class Method { Horizon, Hemisphere, Gaussian };
  enum class Blur { Bilateral, Box, None };
  enum class Apply { Lighting, Multiply };  // Multiply is system A's
  struct Params {
    Method method = Method::Horizon;
    float radius = 0.5f;  // m
    int samples = 24;
    Blur blur = Blur::Bilateral;
    int reach = 256;  // px
    Apply apply = Apply::Lighting;
  };
  struct Ports {
    graph::In<render::ViewData> view;
    graph::In<gpu::Texture> depth, normal;
    graph::Out<gpu::Texture> ambientVisibility;
    graph::InOut<gpu::Texture> color;  // of Apply::Multiply
  };

  static void describe(graph::PassInfo<Params, Ports>& d);
  explicit ScreenSpaceAo(gpu::Device& device);
  void execute(graph::PassContext& context, const Params& params, const Ports& ports);

 private:
  void setSamples(const Params& params, std::uint64_t seed);
  void blur(gpu::Device& device, const Params& params, const Ports& ports, const gpu::Texture& from,
            const gpu::Texture& to, vec2 direction);
  void multiply(gpu::Device& device, const Ports& ports);

  std::array<gpu::ProgramPtr, 3> programs_;  // of each method
  gpu::ProgramPtr blurProgram_, multiplyProgram_;
  std::array<gpu::Texture, 2> between_;  // before the blur, and blurred along x
  std::vector<vec4> offsets_;            // of the sampling methods
  std::array<vec4, 16> rotations_{};     // of four by four pixels: cosine, sine, share of a turn
};

}  // namespace lucerna::passes
