#include "render/shadow_maps.hpp"

#include <algorithm>

#include "render/blocks.hpp"

namespace lucerna::render {

bool ShadowMaps::Place::overlaps(const Place& other) const {
  return local == other.local && layer == other.layer &&
         glm::all(glm::lessThan(corner, other.corner + other.side)) &&
         glm::all(glm::lessThan(other.corner, corner + side));
}

namespace {

void fit(gpu::Device& device, ShadowMaps& shadowMaps, bool local, const ShadowMapSize& size) {
  gpu::Texture& texture = local ? shadowMaps.local : shadowMaps.directional;
  if (size.layers == 0 && texture) return;
  const int side = size.layers > 0 ? size.side : 1, layers = std::max(size.layers, 1);
  if (texture && texture.width() == side && texture.desc().layers == layers) return;
  texture = {};  // before the new one is made
  std::erase_if(shadowMaps.drawn,
                [&](const ShadowMaps::Drawn& drawn) { return drawn.place.local == local; });
  texture =
      device.createTexture({.kind = gpu::TextureKind::Array2D,
                            .format = gpu::Format::Depth32F,
                            .width = side,
                            .height = side,
                            .layers = layers},
                           local ? "local shadow maps" : "directional shadow maps", size.remedy);
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
                    .place = uvec4(place.layer, place.local ? 1 : 0, 0, 0)});
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
}

}  // namespace lucerna::render
