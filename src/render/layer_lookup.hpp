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
  float normalBias = 1.f;
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

// A member of Ports, which derives from LayerLookupPorts.
template <typename Ports, typename Member>
Member Ports::* lookupPort(Member LayerLookupPorts::* member) {
  return member;
}

// The bias of Params, which derives from LayerLookupParams.
template <typename Params, typename Ports>
void describeLookupBias(graph::PassInfo<Params, Ports>& d) {
  describeShadowBias(d, static_cast<float Params::*>(&LayerLookupParams::bias),
                     static_cast<float Params::*>(&LayerLookupParams::normalBias));
}

// The ports but for those of the G-buffer and its view.
template <typename Params, typename Ports>
void describeLookupLights(graph::PassInfo<Params, Ports>& d) {
  d.read("lights", lookupPort<Ports>(&LayerLookupPorts::lights)).help("Lights that are on.");
  d.read("tileLights", lookupPort<Ports>(&LayerLookupPorts::tileLights))
      .optional()
      .help("Which lights may reach a pixel; without it each pixel tries them all.");
  d.read("shadowMaps", lookupPort<Ports>(&LayerLookupPorts::shadowMaps))
      .optional()
      .help("What each light sees; without it nothing is blocked.");
  d.read("shadowLayers", lookupPort<Ports>(&LayerLookupPorts::shadowLayers))
      .optional()
      .help("The layer of each light; without it there are none.");
}

// Params and Ports: derived from those above. around: px, how far from a pixel others are looked up
// for it, too.
template <typename Params, typename Ports>
void describeLayerLookup(graph::PassInfo<Params, Ports>& d, int around = 0) {
  describeLookupBias(d);
  d.read("view", lookupPort<Ports>(&LayerLookupPorts::view))
      .help("The view that the G-buffer was drawn from.");
  describeLookupLights(d);
  d.read("depth", lookupPort<Ports>(&LayerLookupPorts::depth))
      .texture(gpu::Format::Depth32F)
      .halo(around + 1)
      .help("Reversed depth.");
  d.read("normal", lookupPort<Ports>(&LayerLookupPorts::normal))
      .texture(gpu::Format::Rg16Unorm)
      .sameSizeAs("depth")
      .halo(around)
      .help("View-space normal, octahedral.");
}

// All that render/layer_lookup.glsl reads. The ports have layers. reach: shadowReach of
// render/shadows.glsl, texels.
void bindLayerLookup(gpu::Rendering& rendering, const gpu::Program& program,
                     const LayerLookupParams& params, const LayerLookupPorts& ports, float reach);

}  // namespace lucerna::render
