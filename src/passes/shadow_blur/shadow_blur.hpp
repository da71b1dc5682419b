// ShadowBlur: soft shadows in screen space, from a mask of hard ones and the widths of penumbrae.
#pragma once

#include <map>
#include <string>

#include "render/layer_widths.hpp"
#include "render/layered_shadows.hpp"
#include "render/penumbra_blur.hpp"

namespace lucerna::passes {

class ShadowBlur {
 public:
  enum class From { Stored, Sampled };  // of penumbrae
  struct Params : render::LayerLookupParams, render::PenumbraBlurParams {
    From penumbrae = From::Stored;
    render::LayeredVariant variant = render::LayeredVariant::Mended;
  };
  struct Ports : render::LayerWidthPorts {  // but for view, depth and normal: of sampled
    graph::In<render::Penumbrae> penumbrae;
    graph::In<gpu::Texture> shadowMask;
    graph::In<render::ShadowValues> shadowValues;
    graph::Out<render::LayeredShadows> layeredShadows;
  };

  static void describe(graph::PassInfo<Params, Ports>& d);
  explicit ShadowBlur(gpu::Device& device) : device_(device) {}
  void execute(graph::PassContext& context, const Params& params, const Ports& ports);

 private:
  void blur(const Params& params, const Ports& ports, bool first, const gpu::Texture& to);
  const gpu::Program& programOf(const Params& params, const Ports& ports, bool first);
  void bind(gpu::Rendering& rendering, const gpu::Program& program, const Params& params,
            const Ports& ports, bool first);

  gpu::Device& device_;
  std::map<gpu::ProgramDesc, gpu::ProgramPtr> programs_;
  gpu::Texture along_;  // blurred along x
};

}  // namespace lucerna::passes
