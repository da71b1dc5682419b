// ShadowMask: for each pixel a bit for each layer, set where the layer's light is blocked.
#pragma once

#include "graph/pass_info.hpp"
#include "render/light_list.hpp"
#include "render/shadow_layers.hpp"
#include "render/shadow_maps.hpp"
#include "render/tile_lights.hpp"
#include "render/view_data.hpp"

namespace lucerna::passes {

class ShadowMask {
 public:
  struct Params {
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
    graph::Out<gpu::Texture> shadowMask;
  };

  static void describe(graph::PassInfo<Params, Ports>& d);
  explicit ShadowMask(gpu::Device& device);
  void execute(graph::PassContext& context, const Params& params, const Ports& ports);

 private:
  gpu::ProgramPtr ofAllLights_, ofTiles_;
};

}  // namespace lucerna::passes
