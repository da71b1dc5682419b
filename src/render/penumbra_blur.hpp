// What the passes have in common that blur layers by the width of penumbrae: ShadowBlur and
// LayeredTransmittance. GLSL: render/penumbra_blur.glsl.
#pragma once

#include <cmath>

#include "graph/pass_info.hpp"
#include "render/layered_shadows.hpp"

namespace lucerna::render {

struct PenumbraBlurParams {
  int kernel = 11;             // taps along each axis, odd
  float maximumRadius = 48.f;  // px of the picture
  float edgeStop = 0.05f;      // m
  LayerResolution resolution = LayerResolution::Half;
};

// Params: derived from that above.
template <typename Params, typename Ports>
void describePenumbraBlur(graph::PassInfo<Params, Ports>& d) {
  d.param("kernel", static_cast<int Params::*>(&PenumbraBlurParams::kernel))
      .range(3, 47)
      .help(
          "Taps along each of two axes, odd, an even number being taken as the next; they spread "
          "over the widest penumbra of a pixel.");
  d.param("maximumRadius", static_cast<float Params::*>(&PenumbraBlurParams::maximumRadius))
      .range(2, 256)
      .unit("px")
      .rebuilds(graph::Rebuild::Ports)
      .help("Along each axis nothing farther away counts: larger penumbrae are cut off.");
  d.param("edgeStop", static_cast<float Params::*>(&PenumbraBlurParams::edgeStop))
      .range(0.0001, 100)
      .unit("m")
      .help(
          "What is farther off a pixel's tangent plane than this, and than a pixel is wide there, "
          "is another surface and does not count.");
  d.param("resolution", static_cast<LayerResolution Params::*>(&PenumbraBlurParams::resolution))
      .choices({"half", "full"})
      .help("Of the picture: half stands for two pixels along each axis, of which it takes all.");
}

// How far from a pixel others count, px: both axes reach along x, as the second is askew.
inline int haloOf(const PenumbraBlurParams& params) {
  return 2 * static_cast<int>(std::ceil(params.maximumRadius)) + 4;
}

}  // namespace lucerna::render
