// DepthOfField: the picture through a thin lens, from the sharp picture and its depth.
#pragma once

#include <array>

#include "graph/pass_info.hpp"
#include "render/gpu_scene.hpp"
#include "render/view_data.hpp"

namespace lucerna::passes {

class DepthOfField {
 public:
  enum class Method { Gather, Separable };  // Separable is system A's (README.md)
  enum class Show { Picture, Setup };
  // Lens and focus are those of the reference (trace/), which makes the same picture by rays.
  struct Params {
    float lensRadius = 0.f;      // m; 0: everything is sharp
    float focusDistance = 1.f;   // m along the view
    float maximumRadius = 32.f;  // px of a circle of confusion
    Method method = Method::Gather;
    int steps = 8;        // Gather
    float scale = 0.75f;  // Separable
    Show show = Show::Picture;
  };
  struct Ports {
    graph::In<render::GpuScene> scene;
    graph::In<render::ViewData> view;
    graph::In<gpu::Texture> input, depth;
    graph::Out<gpu::Texture> output;
  };

  static void describe(graph::PassInfo<Params, Ports>& d);
  explicit DepthOfField(gpu::Device& device);
  void execute(graph::PassContext& context, const Params& params, const Ports& ports);

 private:
  struct Layer {
    gpu::Texture light, cover;
  };
  struct Inputs {
    const Params& params;
    const Ports& ports;
    vec4 lens;  // circle.glsl
  };
  void gather(gpu::Device& device, const Inputs& in);
  void fitGather(gpu::Device& device, ivec2 size);
  void findLargest(gpu::Device& device, const Inputs& in);
  void makeLayer(gpu::Device& device, const Inputs& in, float side, const Layer& layer);
  void blur(gpu::Device& device, const Inputs& in);
  void blurAlong(gpu::Device& device, const Inputs& in, const gpu::Texture& from,
                 const gpu::Texture& to, vec2 pixelsOfFrom, vec2 direction);
  void setUp(gpu::Device& device, const Inputs& in);

  gpu::ProgramPtr tilesProgram_, spreadProgram_, layerOfPictureProgram_, layerProgram_,
      behindProgram_, gatherProgram_;
  gpu::Texture tiles_, largest_, widest_;        // largest circles of 16 by 16 px
  Layer along_, near_, far_;                     // of wide circles; along_: smoothed along x
  gpu::Texture behind_, narrow_, narrowRadius_;  // a quarter of the size
  gpu::ProgramPtr blurProgram_, combineProgram_, setupProgram_;
  std::array<gpu::Texture, 2> small_;  // of the separable method, blurred along x and both
};

}  // namespace lucerna::passes
