// ShowGBuffer: one component of the G-buffer as a picture.
#pragma once

#include "graph/pass_info.hpp"
#include "render/view_data.hpp"

namespace lucerna::passes {

class ShowGBuffer {
 public:
  enum class Component {
    Depth,
    Normal,
    Albedo,
    Specular,
    Occlusion,
    Material,
    Shininess,
    Metallic,
    Emissive,
    Position
  };
  struct Params {
    Component component = Component::Normal;
    float scale = 10.f;
  };
  struct Ports {
    graph::In<render::ViewData> view;
    graph::In<gpu::Texture> depth, normal, albedo, specular, material, emissive;
    graph::In<gpu::Texture> input;
    graph::Out<gpu::Texture> output;
  };

  static void describe(graph::PassInfo<Params, Ports>& d);
  explicit ShowGBuffer(gpu::Device& device);
  void execute(graph::PassContext& context, const Params& params, const Ports& ports);

 private:
  gpu::ProgramPtr program_;
};

}  // namespace lucerna::passes
