// TiledLighting: shades the G-buffer with all lights, less what shadow maps block.
#pragma once

#include <map>
#include <string>

#include "graph/pass_info.hpp"
#include "render/gpu_scene.hpp"
#include "render/layered_shadows.hpp"
#include "render/light_list.hpp"
#include "render/prefiltered_shadows.hpp"
#include "render/shadow_layers.hpp"
#include "render/shadow_maps.hpp"
#include "render/tile_lights.hpp"
#include "render/view_data.hpp"

namespace lucerna::passes {

class TiledLighting {
 public:
  enum class Shadows { None, Hard, Pcf, Pcss, Prefiltered, Layered };
  enum class Comparison { Nearest, Filtered, Plane };
  struct Params {
    float ambient = 1.f;
    Shadows shadows = Shadows::Pcf;
    int kernel = 3;  // comparisons along each side, odd
    int search = 5;  // depths along each side, odd
    Comparison comparison = Comparison::Filtered;
    float bias = 0.f;  // m
    float normalBias = 1.f;
  };
  struct Ports {
    graph::In<render::GpuScene> scene;
    graph::In<render::ViewData> view;
    graph::In<render::LightList> lights;
    graph::In<render::TileLights> tileLights;
    graph::In<render::ShadowMaps> shadowMaps;
    graph::In<render::PrefilteredShadows> prefilteredShadows;
    graph::In<render::ShadowLayers> shadowLayers;
    graph::In<render::LayeredShadows> layeredShadows;
    graph::In<render::LayeredTransmittance> layeredTransmittance;
    graph::In<gpu::Texture> shadowMask;
    graph::In<gpu::Texture> depth, normal, albedo, specular, material, emissive, ambientVisibility,
        bakedIrradiance;
    graph::InOut<gpu::Texture> color;
  };

  static void describe(graph::PassInfo<Params, Ports>& d);
  explicit TiledLighting(gpu::Device& device) : device_(device) {}
  void execute(graph::PassContext& context, const Params& params, const Ports& ports);

 private:
  gpu::Rendering begin(gpu::Device& device, const Params& params, const Ports& ports);
  void draw(gpu::Rendering& rendering, const char* shader, const Params& params, const Ports& ports,
            gpu::Blend blend);
  // The variant for what is bound, compiled when it is first asked for.
  const gpu::Program& programOf(const char* shader, const Params& params, const Ports& ports);

  gpu::Device& device_;
  std::map<gpu::ProgramDesc, gpu::ProgramPtr> programs_;
  bool warned_ = false;
};

}  // namespace lucerna::passes
