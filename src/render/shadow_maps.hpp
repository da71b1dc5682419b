// Shadow maps of many lights, as ShadowMaps makes them and render/shadows.glsl reads them.
#pragma once

#include <string_view>
#include <vector>

#include "gpu/device.hpp"
#include "render/shadow_projection.hpp"

namespace lucerna::render {

// Light-space depth, reversed, in layers of two array textures: one resolution for directional
// lights and one for lamps.
struct ShadowMaps {
  static constexpr const char* kPortName = "ShadowMaps";
  struct Map {
    ShadowProjection projection;
    bool local = false;  // of a spot or point light: a layer of `local`, not of `directional`
    int layer = 0;
  };
  struct Range {
    std::uint32_t first = 0, count = 0;  // count 0: the light throws no shadow
  };
  std::vector<Map> maps;
  // Of each light of the LightList. Where several maps show a point the first of them counts.
  std::vector<Range> ofLight;
  // Depth32F arrays; of one texel where there is no map
  gpu::Texture directional, local;
  // What a layer shows: what it was drawn from last, or nothing yet.
  struct Drawn {
    ShadowProjection projection;
    std::uint64_t geometryRevision = 0;  // of GpuScene; 0: nothing
    bool operator==(const Drawn&) const = default;
  };
  std::vector<Drawn> drawnDirectional, drawnLocal;  // of each layer
  gpu::Buffer mapBlock, lightBlock;
  std::uint64_t revision = 0;  // grows when a map is drawn
};

// Free at each edge of a map, in texels, so that filters of up to nine by nine stay inside it, with
// the way that points are moved before they are compared.
inline constexpr int kShadowMargin = 12;

struct ShadowMapSize {
  int side = 1;               // texels
  std::string_view remedy{};  // what a user may do where maps of it do not fit (gpu::OutOfMemory)
};
// Makes textures of the given sizes and the blocks for maps and ofLight. What the textures show is
// up to the caller.
void prepareShadowMaps(gpu::Device& device, ShadowMaps& shadowMaps,
                       const ShadowMapSize& directional, const ShadowMapSize& local);

void bindShadowMaps(gpu::Commands& commands, const ShadowMaps& shadowMaps, bool filtered);

}  // namespace lucerna::render
