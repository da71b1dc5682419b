// LayeredTransmittance: how translucent surfaces colour light, with soft edges, in screen space.
#pragma once

#include <map>

#include "render/layer_widths.hpp"
#include "render/layered_shadows.hpp"
#include "render/nearest_blockers.hpp"
#include "render/penumbra_blur.hpp"

namespace lucerna::passes {

class LayeredTransmittance {
 public:
  using Method = render::LayerWidthParams::Method;
  struct Params : render::LayerLookupParams,
                  render::LayerWidthParams,
                  render::PenumbraBlurParams {};
  struct Ports : render::LayerLookupPorts {
    graph::In<render::NearestBlockers> nearestBlockers;
    graph::Out<render::LayeredTransmittance> layeredTransmittance;
  };

  static void describe(graph::PassInfo<Params, Ports>& d);
  explicit LayeredTransmittance(gpu::Device& device) : device_(device) {}
  void execute(graph::PassContext& context, const Params& params, const Ports& ports);

 private:
  const gpu::Program& programOf(const gpu::ProgramDesc& desc);
  void makeTextures(const Ports& ports);
  // Of `count` array layers of the output from the first on, into hard_ and widths_.
  void findHard(const Params& params, const Ports& ports, int first, int count);
  // Of a layer of hard_ into alongX_, and from there to `to`.
  void blur(const Params& params, const Ports& ports, int layer, const gpu::ColorTarget& to);
  void blurAxis(const Params& params, const Ports& ports, int layer, bool alongX,
                const gpu::ColorTarget& to);

  gpu::Device& device_;
  std::map<gpu::ProgramDesc, gpu::ProgramPtr> programs_;
  gpu::Texture hard_, widths_, alongX_;
};

}  // namespace lucerna::passes
