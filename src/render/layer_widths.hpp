// What the passes have in common that find how wide the penumbra of each layer is at a pixel:
// Penumbra, and ShadowBlur where nothing is stored. GLSL: render/layer_widths.glsl.
#pragma once

#include "render/layer_lookup.hpp"
#include "render/nearest_blockers.hpp"

namespace lucerna::render {

// How wide a penumbra is.
struct LayerWidthParams {
  enum class Method { Search, Minimum };
  Method method = Method::Search;
  int search = 5;  // depths along each side, odd
};

// Params: derived from that above.
template <typename Params, typename Ports>
void describeWidths(graph::PassInfo<Params, Ports>& d) {
  d.param("method", static_cast<LayerWidthParams::Method Params::*>(&LayerWidthParams::method))
      .choices({"search", "minimum"})
      .rebuilds(graph::Rebuild::Ports)
      .help(
          "How wide penumbrae are. search: by the mean distance of what is in the light's way "
          "around a point; minimum: by that of the nearest to the light, from NearestBlockers.");
  d.param("search", static_cast<int Params::*>(&LayerWidthParams::search))
      .range(3, 47)
      .help(
          "search: depths along each side of a light's map that are read, odd, an even number "
          "being taken as the next.");
}

struct LayerWidthPorts : LayerLookupPorts {
  graph::In<TileLights> partlyLit;
  graph::In<NearestBlockers> nearestBlockers;  // null: blockers are searched
};

// Ports: derived from that above.
template <typename Params, typename Ports>
void describePartlyLit(graph::PassInfo<Params, Ports>& d) {
  d.read("partlyLit", static_cast<graph::In<TileLights> Ports::*>(&LayerWidthPorts::partlyLit))
      .optional()
      .help("Lights that have penumbrae in a tile; without it all that reach it may.");
}
template <typename Params, typename Ports>
void describeNearestBlockers(graph::PassInfo<Params, Ports>& d) {
  d.read("nearestBlockers",
         static_cast<graph::In<NearestBlockers> Ports::*>(&LayerWidthPorts::nearestBlockers))
      .optional()
      .help("Small copies of the maps; without it no layer has penumbrae.");
}

// The macros and all that render/layer_widths.glsl reads. The ports have layers.
void defineLayerWidths(gpu::ProgramDesc& desc, const LayerWidthPorts& ports);
void bindLayerWidths(gpu::Rendering& rendering, const gpu::Program& program,
                     const LayerLookupParams& params, const LayerWidthPorts& ports,
                     LayeredVariant variant);

}  // namespace lucerna::render
