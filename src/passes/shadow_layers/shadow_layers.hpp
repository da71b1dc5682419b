// ShadowLayers: which lights may share a layer of screen-space shadows.
#pragma once

#include <set>
#include <string>

#include "graph/pass_info.hpp"
#include "passes/shadow_layers/colour_lights.hpp"
#include "render/gpu_scene.hpp"
#include "render/light_list.hpp"
#include "render/shadow_layers.hpp"
#include "render/shadow_maps.hpp"
#include "render/tile_lights.hpp"

namespace lucerna::passes {

class ShadowLayers {
 public:
  enum class Conflicts { Spheres, Tiles };
  struct Params {
    int layers = 8;
    Conflicts conflicts = Conflicts::Tiles;
    int apart = 48;  // px
    ColourOrder order = ColourOrder::Saturation;
    bool sunAlone = true;
    render::LayeredVariant variant = render::LayeredVariant::Mended;
  };
  struct Ports {
    graph::In<render::GpuScene> scene;
    graph::In<render::LightList> lights;
    graph::In<render::ShadowMaps> shadowMaps;
    graph::In<render::TileLights> tileLights;
    graph::Out<render::ShadowLayers> shadowLayers;
  };

  static void describe(graph::PassInfo<Params, Ports>& d);
  explicit ShadowLayers(gpu::Device& device)
      : conflictsProgram_(device.program({.compute = "passes/shadow_layers/conflicts.comp"})) {}
  void execute(graph::PassContext& context, const Params& params, const Ports& ports);

 private:
  OverlapGraph overlaps(gpu::Device& device, const Params& params, const Ports& ports,
                        const std::vector<bool>& shadowed);
  void warnOf(const std::vector<std::string>& beyond, int layers);

  gpu::ProgramPtr conflictsProgram_;
  gpu::Buffer conflicts_;
  std::set<std::string> warned_;
};

}  // namespace lucerna::passes
