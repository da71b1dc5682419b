// ShadowedLighting: Lighting in which shadow maps take away the light that they block.
#pragma once

#include "render/deferred_shading.hpp"
#include "render/gpu_scene.hpp"
#include "render/shadow_maps.hpp"

namespace lucerna::passes {

class ShadowedLighting {
 public:
  enum class Filter { Nearest, Hardware, Pcf3, Pcf5, Pcf7, Pcf9 };
  struct Params {
    float ambient = 1.f;
    Filter filter = Filter::Pcf3;
    float bias = 0.f;  // m
    float normalBias = 1.f;
  };
  struct Ports : render::DeferredPorts {
    graph::In<render::GpuScene> scene;
    graph::In<render::ShadowMaps> shadowMaps;
  };

  static void describe(graph::PassInfo<Params, Ports>& d);
  explicit ShadowedLighting(gpu::Device& device);
  void execute(graph::PassContext& context, const Params& params, const Ports& ports);

 private:
  render::DeferredProgram lighting_, darkening_;
  render::ShadowMaps noMaps_;
};

}  // namespace lucerna::passes
