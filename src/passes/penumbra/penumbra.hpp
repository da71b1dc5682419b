// Penumbra: how wide penumbrae are, for each layer of screen-space shadows, at half the size.
#pragma once

#include <map>

#include "graph/pass_info.hpp"
#include "render/layered_shadows.hpp"
#include "render/light_list.hpp"
#include "render/shadow_layers.hpp"
#include "render/shadow_maps.hpp"
#include "render/tile_lights.hpp"
#include "render/view_data.hpp"

namespace lucerna::passes {

class Penumbra {
 public:
  struct Params {
    int search = 5;    // depths along each side, odd
    float bias = 0.f;  // m
    float normalBias = 1.f;
  };
  struct Ports {
    graph::In<render::ViewData> view;
    graph::In<render::LightList> lights;
    graph::In<render::TileLights> tileLights;
    graph::In<render::ShadowMaps> shadowMaps;
    graph::In<render::ShadowLayers> shadowLayers;
    graph::In<gpu::Texture> depth, normal;
    graph::Out<render::Penumbrae> penumbrae;
  };

  static void describe(graph::PassInfo<Params, Ports>& d);
  explicit Penumbra(gpu::Device& device) : device_(device) {}
  void execute(graph::PassContext& context, const Params& params, const Ports& ports);

 private:
  const gpu::Program& programOf(const Ports& ports, int arrayLayers);

  gpu::Device& device_;
  std::map<gpu::ProgramDesc, gpu::ProgramPtr> programs_;
};

}  // namespace lucerna::passes
