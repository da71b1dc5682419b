// NearestBlockers: what is nearest to each light, in blocks of its maps' texels.
#pragma once

#include "graph/pass_info.hpp"
#include "render/nearest_blockers.hpp"
#include "render/shadow_maps.hpp"

namespace lucerna::passes {

class NearestBlockers {
 public:
  struct Params {};
  struct Ports {
    graph::In<render::ShadowMaps> shadowMaps;
    graph::Out<render::NearestBlockers> nearestBlockers;
  };

  static void describe(graph::PassInfo<Params, Ports>& d);
  explicit NearestBlockers(gpu::Device& device);
  void execute(graph::PassContext& context, const Params& params, const Ports& ports);

 private:
  void reduce(gpu::Device& device, const gpu::Texture& maps, gpu::Texture& nearest);

  gpu::ProgramPtr ofMaps_, ofBlocks_;
  std::uint64_t revision_ = 0;  // of the maps that were reduced last
};

}  // namespace lucerna::passes
