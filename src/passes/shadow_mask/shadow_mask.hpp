// ShadowMask: for each pixel a bit for each layer, set where the layer's light is blocked; and, if
// wanted, a byte that says by how far the blocker is away.
#pragma once

#include <map>

#include "render/layer_lookup.hpp"
#include "render/layered_shadows.hpp"

namespace lucerna::passes {

class ShadowMask {
 public:
  enum class Values { Bits, Exponential };
  struct Params : render::LayerLookupParams {
    Values values = Values::Bits;
    float falloff = 40.f;  // 1/m
    render::LayeredVariant variant = render::LayeredVariant::Mended;
  };
  struct Ports : render::LayerLookupPorts {
    graph::Out<gpu::Texture> shadowMask;
    graph::Out<render::ShadowValues> shadowValues;
  };

  static void describe(graph::PassInfo<Params, Ports>& d);
  explicit ShadowMask(gpu::Device& device)
      : device_(device),
        bitsOfValues_(device.program({.vertex = "gpu/fullscreen.vert",
                                      .fragment = "passes/shadow_mask/mask_of_values.frag"})) {}
  void execute(graph::PassContext& context, const Params& params, const Ports& ports);

 private:
  const gpu::Program& programOf(const Params& params, const Ports& ports);
  void drawBits(const Params& params, const Ports& ports);
  void drawValues(const Params& params, const Ports& ports);
  void drawBitsOfValues(const Ports& ports);

  gpu::Device& device_;
  gpu::ProgramPtr bitsOfValues_;
  std::map<gpu::ProgramDesc, gpu::ProgramPtr> programs_;
};

}  // namespace lucerna::passes
