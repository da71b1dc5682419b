// ShadowTiles: which lights are partly blocked in or near each tile of 16 x 16 pixels.
#pragma once

#include "graph/pass_info.hpp"
#include "render/layered_shadows.hpp"
#include "render/light_list.hpp"
#include "render/shadow_layers.hpp"
#include "render/tile_lights.hpp"

namespace lucerna::passes {

class ShadowTiles {
 public:
  struct Params {
    int reach = 48;  // px
  };
  struct Ports {
    graph::In<render::LightList> lights;
    graph::In<render::TileLights> tileLights;
    graph::In<render::ShadowLayers> shadowLayers;
    graph::In<gpu::Texture> shadowMask, depth;
    graph::In<render::ShadowValues> shadowValues;
    graph::Out<render::TileLights> partlyLit;
  };

  static void describe(graph::PassInfo<Params, Ports>& d);
  explicit ShadowTiles(gpu::Device& device);
  void execute(graph::PassContext& context, const Params& params, const Ports& ports);

 private:
  gpu::ProgramPtr bitsProgram_, valuesProgram_, lightsProgram_;
  gpu::Buffer tileBits_;  // two words a tile: layers that are blocked, and that are lit, somewhere
};

}  // namespace lucerna::passes
