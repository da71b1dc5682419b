#include "render/shadow_maps.hpp"

#include <algorithm>
#include <string>

#include "render/blocks.hpp"

namespace lucerna::render {

bool ShadowMaps::Place::overlaps(const Place& other) const {
  return local == other.local && layer == other.layer &&
         glm::all(glm::lessThan(corner, other.corner + other.side)) &&
         glm::all(glm::lessThan(other.corner, corner + side));
}

bool ShadowMaps::seesPanes() const {
  return std::ranges::any_of(maps, &Map::seesPanes);
}

namespace {

// Whether it had to be made anew.
bool fit(gpu::Device& device, gpu::Texture& texture, gpu::Format format, int side, int layers,
         const std::string& label, std::string_view remedy) {
  if (texture && texture.width() == side && texture.desc().layers == layers) return false;
  texture = {};  // before the new one is made
  texture = device.createTexture({.kind = gpu::TextureKind::Array2D,
                                  .format = format,
                                  .width = side,
                                  .height = side,
                                  .layers = layers},
                                 label, remedy);
  return true;
}

void fit(gpu::Device& device, ShadowMaps& shadowMaps, bool local, const ShadowMapSize& size) {
  gpu::Texture& depth = local ? shadowMaps.local : shadowMaps.directional;
  ShadowMaps::Panes& ofPanes = local ? shadowMaps.localPanes : shadowMaps.directionalPanes;
  if (size.layers == 0 && depth) return;
  const int side = size.layers > 0 ? size.side : 1, layers = std::max(size.layers, 1);
  const std::string kind = local ? "local" : "directional";
  bool anew =
      fit(device, depth, gpu::Format::Depth32F, side, layers, kind + " shadow maps", size.remedy);
  const bool panes = std::ranges::any_of(shadowMaps.maps, [&](const ShadowMaps::Map& map) {
    return map.seesPanes && map.place.local == local;
  });
  if (panes || !ofPanes.depth) {
    const int paneSide = panes ? side : 1, paneLayers = panes ? layers : 1;
    anew |= fit(device, ofPanes.halvings, gpu::Format::Rgba16Unorm, paneSide, paneLayers,
                kind + " panes", size.remedy);
    anew |= fit(device, ofPanes.depth, gpu::Format::Depth32F, paneSide, paneLayers,
                kind + " panes' depth", size.remedy);
  }
  if (anew)
    std::erase_if(shadowMaps.drawn,
                  [&](const ShadowMaps::Drawn& drawn) { return drawn.place.local == local; });
}

}  // namespace

void prepareShadowMaps(gpu::Device& device, ShadowMaps& shadowMaps,
                       const ShadowMapSize& directional, const ShadowMapSize& local) {
  fit(device, shadowMaps, false, directional);
  fit(device, shadowMaps, true, local);
  std::vector<blocks::ShadowMapValues> maps;
  for (const ShadowMaps::Map& map : shadowMaps.maps) {
    const ShadowMaps::Place& place = map.place;
    const gpu::Texture& texture = place.local ? shadowMaps.local : shadowMaps.directional;
    const float texel = 1.f / static_cast<float>(place.side);
    const float ofLayer = 1.f / static_cast<float>(texture.width());
    maps.push_back({.clipFromWorld = map.projection.clipFromWorld(),
                    .texel = vec4(map.projection.side * texel, texel, map.projection.shear),
                    .axisW = vec4(vec3(glm::transpose(map.projection.viewFromWorld)[2]),
                                  map.projection.depthRange),
                    .depthPlaneW = map.projection.depthPlaneW,
                    .inner = vec4(map.projection.inner, map.projection.clipFromView[3][2],
                                  map.projection.clipFromView[2][2], 0.f),
                    .square = vec4(vec2(place.corner), place.side, 0.f) * ofLayer,
                    .place = uvec4(place.layer, place.local ? 1 : 0, map.seesPanes ? 1 : 0, 0)});
  }
  std::vector<uvec4> lights;
  for (const ShadowMaps::Range& range : shadowMaps.ofLight)
    lights.emplace_back(range.first, range.count, 0, 0);
  // A block of no elements cannot be bound.
  maps.resize(std::max<std::size_t>(maps.size(), 1));
  lights.resize(std::max<std::size_t>(lights.size(), 1));
  device.write(shadowMaps.mapBlock, std::as_bytes(std::span(maps)), "ShadowMapBlock");
  device.write(shadowMaps.lightBlock, std::as_bytes(std::span(lights)), "ShadowLightBlock");
}

void bindShadowMaps(gpu::Commands& commands, const ShadowMaps& shadowMaps, bool filtered) {
  // Beyond its border a map shows nothing, and all is lit.
  const gpu::Sampler sampler{.filter = filtered ? gpu::Filter::Linear : gpu::Filter::Nearest,
                             .u = gpu::Address::ClampToBorder,
                             .v = gpu::Address::ClampToBorder,
                             .compareGreaterEqual = true};
  commands.buffer("ShadowMapBlock", shadowMaps.mapBlock);
  commands.buffer("ShadowLightBlock", shadowMaps.lightBlock);
  commands.texture("directionalShadowMaps", shadowMaps.directional, sampler);
  commands.texture("localShadowMaps", shadowMaps.local, sampler);
  const gpu::Sampler depths{.filter = gpu::Filter::Nearest,
                            .u = gpu::Address::ClampToBorder,
                            .v = gpu::Address::ClampToBorder};
  commands.texture("directionalShadowDepths", shadowMaps.directional, depths);
  commands.texture("localShadowDepths", shadowMaps.local, depths);
  commands.texture("directionalPaneHalvings", shadowMaps.directionalPanes.halvings, depths);
  commands.texture("localPaneHalvings", shadowMaps.localPanes.halvings, depths);
  commands.texture("directionalPaneDepths", shadowMaps.directionalPanes.depth, depths);
  commands.texture("localPaneDepths", shadowMaps.localPanes.depth, depths);
}

}  // namespace lucerna::render
