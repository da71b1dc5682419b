// ShadowMaps: what each light sees, once for all pictures of a frame.
#pragma once

#include <vector>

#include "graph/pass_info.hpp"
#include "passes/shadow_maps/draw_maps.hpp"
#include "passes/shadow_maps/lamp_sizes.hpp"
#include "passes/shadow_maps/shadow_atlas.hpp"
#include "render/light_list.hpp"
#include "render/shadow_maps.hpp"
#include "render/view_group.hpp"

namespace lucerna::passes {

// Of lamps, what a frame's plan hands on to the next.
struct LampMaps {
  LampSizes sizes;
  ShadowAtlas atlas;
};

class ShadowMaps {
 public:
  enum class Method { Lispsm, Uniform, Cascades };
  enum class Warp { Automatic, Set };
  enum class Redraw { Changed, Always };
  static constexpr int kLeastSide = 16;  // texels
  struct Params {
    Method method = Method::Lispsm;
    int size = 2048;  // texels
    Warp warp = Warp::Automatic;
    float warpStrength = 4.f;
    int cascades = 4;
    int localSize = 512;  // texels
    int localLights = 64;
    int localMemory = 512;  // MiB
    Redraw redraw = Redraw::Changed;
  };
  struct Ports {
    graph::In<render::GpuScene> scene;
    graph::In<render::LightList> lights;
    graph::In<render::ViewGroup> views;
    graph::Out<render::ShadowMaps> shadowMaps;
  };

  static void describe(graph::PassInfo<Params, Ports>& d);
  explicit ShadowMaps(gpu::Device& device)
      : drawer_(device, drawsLayersTogether(device.capabilities())) {}
  void execute(graph::PassContext& context, const Params& params, const Ports& ports);

 private:
  // Software rasterisers have nothing to gain from few draws, and lose by layers.
  static bool drawsLayersTogether(const gpu::Capabilities& capabilities) {
    return capabilities.features.contains(gpu::kFeatureLayeredVertex) &&
           !capabilities.softwareRasterizer;
  }
  void warnOfLamps(int withMaps, int leftOut, const char* remedy);

  MapDrawer drawer_;
  LampMaps lamps_;
  int mostLeftOut_ = 0;  // lamps without a map, so far
};

}  // namespace lucerna::passes
