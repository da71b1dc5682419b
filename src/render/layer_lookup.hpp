// What passes have in common that look the pixels of a G-buffer up in shadow maps, for the layers
// of screen-space shadows (render/shadow_layers.hpp): parameters and ports, declared and bound in
// one place. GLSL: render/layer_lookup.glsl.
#pragma once

#include <type_traits>
#include <utility>

#include "gpu/device.hpp"
#include "graph/pass_info.hpp"
#include "render/light_list.hpp"
#include "render/shadow_layers.hpp"
#include "render/shadow_maps.hpp"
#include "render/tile_lights.hpp"
#include "render/view_data.hpp"

namespace lucerna::render {

struct LayerLookupParams {
  float bias = 0.f;  // m
  // Twice what keeps a plane from shadowing itself: nothing smooths the mask, so that what bends
  // between two pixels must not, either.
  float normalBias = 2.f;
};

struct LayerLookupPorts {
  graph::In<ViewData> view;
  graph::In<LightList> lights;
  graph::In<TileLights> tileLights;
  graph::In<ShadowMaps> shadowMaps;
  graph::In<ShadowLayers> shadowLayers;
  graph::In<gpu::Texture> depth, normal;

  bool tiled() const { return tileLights && tileLights->block; }
  // Used; 0 where maps or layers are missing.
  int layers() const { return shadowMaps && shadowLayers ? shadowLayers->count : 0; }
};

// The bias, as all passes that compare with shadow maps have it. Params: has it.
template <typename Params, typename Ports>
void describeShadowBias(graph::PassInfo<Params, Ports>& d, float Params::* bias,
                        float Params::* normalBias) {
  d.param("bias", bias)
      .range(0, 100)
      .unit("m")
      .help("How far a point is moved towards the light before it is compared.");
  d.param("normalBias", normalBias)
      .range(0, 16)
      .help(
          "How far a point is moved off its surface before it is compared, as a factor on what "
          "keeps a plane from shadowing itself: a comparison's reach there times the slope.");
}

// Params and Ports: derived from those above. around: px, how far from a pixel others are looked up
// for it, too.
template <typename Params, typename Ports>
void describeLayerLookup(graph::PassInfo<Params, Ports>& d, int around = 0) {
  const auto port = [](auto LayerLookupPorts::* member) {
    using Member = std::remove_cvref_t<decltype(std::declval<LayerLookupPorts>().*member)>;
    return static_cast<Member Ports::*>(member);
  };
  describeShadowBias(d, static_cast<float Params::*>(&LayerLookupParams::bias),
                     static_cast<float Params::*>(&LayerLookupParams::normalBias));
  d.read("view", port(&LayerLookupPorts::view)).help("The view that the G-buffer was drawn from.");
  d.read("lights", port(&LayerLookupPorts::lights)).help("Lights that are on.");
  d.read("tileLights", port(&LayerLookupPorts::tileLights))
      .optional()
      .help("Which lights may reach a pixel; without it each pixel tries them all.");
  d.read("shadowMaps", port(&LayerLookupPorts::shadowMaps))
      .optional()
      .help("What each light sees; without it nothing is blocked.");
  d.read("shadowLayers", port(&LayerLookupPorts::shadowLayers))
      .optional()
      .help("The layer of each light; without it there are none.");
  d.read("depth", port(&LayerLookupPorts::depth))
      .texture(gpu::Format::Depth32F)
      .halo(around + 1)
      .help("Reversed depth.");
  d.read("normal", port(&LayerLookupPorts::normal))
      .texture(gpu::Format::Rg16Unorm)
      .sameSizeAs("depth")
      .halo(around)
      .help("View-space normal, octahedral.");
}

// All that render/layer_lookup.glsl reads. The ports have layers.
void bindLayerLookup(gpu::Rendering& rendering, const gpu::Program& program,
                     const LayerLookupParams& params, const LayerLookupPorts& ports);

}  // namespace lucerna::render
