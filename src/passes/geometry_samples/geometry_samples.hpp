// GeometrySamples: depth, and normals if asked for, at four places in each pixel.
#pragma once

#include "graph/pass_info.hpp"
#include "render/draw_list.hpp"
#include "render/object_programs.hpp"
#include "render/view_data.hpp"

namespace lucerna::passes {

class GeometrySamples {
 public:
  static constexpr int kSamples = 4;  // a pixel

  enum class Geometry { Depth, DepthAndNormal };
  struct Params {
    Geometry geometry = Geometry::DepthAndNormal;
    bool backFaces = false;
  };
  struct Ports {
    graph::In<render::GpuScene> scene;
    graph::In<render::ViewData> view;
    graph::In<render::DrawLists> drawLists;
    graph::Out<gpu::Texture> depthSamples, normalSamples;
  };

  static void describe(graph::PassInfo<Params, Ports>& d);
  explicit GeometrySamples(gpu::Device& device);
  void execute(graph::PassContext& context, const Params& params, const Ports& ports);

 private:
  render::ObjectPrograms depthPrograms_, normalPrograms_;
};

}  // namespace lucerna::passes
