// Shadow maps of many lights, as ShadowMaps makes them and render/shadows.glsl reads them.
#pragma once

#include <string_view>
#include <vector>

#include "gpu/device.hpp"
#include "render/shadow_projection.hpp"

namespace lucerna::render {

// Light-space depth, reversed, in two array textures: a map of a directional light fills a layer of
// the one, those of lamps share the layers of the other.
struct ShadowMaps {
  static constexpr const char* kPortName = "ShadowMaps";
  // The square that a map fills.
  struct Place {
    bool local = false;  // of a spot or point light: in `local`, not in `directional`
    int layer = 0;
    ivec2 corner{0};  // texels, lower left
    int side = 0;     // texels
    bool operator==(const Place&) const = default;
    bool overlaps(const Place& other) const;
  };
  struct Map {
    ShadowProjection projection;
    Place place;
    bool seesPanes = false;  // translucent surfaces, which colour the light
  };
  struct Range {
    std::uint32_t first = 0, count = 0;  // count 0: the light throws no shadow
  };
  std::vector<Map> maps;
  // Of each light of the LightList. Where several maps show a point the first of them counts.
  std::vector<Range> ofLight;
  // Depth32F arrays; of one texel where there is no map
  gpu::Texture directional, local;
  // Of translucent surfaces; arrays of the same sizes, or of one texel where no map sees any.
  struct Panes {
    gpu::Texture halvings;  // Rgba16Unorm: of all before what is opaque (render/transmittance.glsl)
    gpu::Texture depth;     // Depth32F: of the one that is nearest to the light
  };
  Panes directionalPanes, localPanes;
  bool seesPanes() const;  // some map does
  // What the textures show, and what it was drawn from. No place overlaps another.
  struct Drawn {
    Place place;
    ShadowProjection projection;
    std::uint64_t geometryRevision = 0;  // of GpuScene
    bool operator==(const Drawn&) const = default;
  };
  std::vector<Drawn> drawn;
  gpu::Buffer mapBlock, lightBlock;
  std::uint64_t revision = 0;  // grows when a map is drawn
};

// Free at each edge of a map, in texels, so that filters of up to nine by nine stay inside it, with
// the way that points are moved before they are compared.
inline constexpr int kShadowMargin = 12;

struct ShadowMapSize {
  int side = 1;               // of a layer, texels
  int layers = 0;             // 0: what is there stays
  std::string_view remedy{};  // what a user may do where they do not fit (gpu::OutOfMemory)
};
// Makes textures of the given sizes, or keeps those that have them, and the blocks for maps and
// ofLight. Nothing of a new texture is drawn: what they show is up to the caller.
void prepareShadowMaps(gpu::Device& device, ShadowMaps& shadowMaps,
                       const ShadowMapSize& directional, const ShadowMapSize& local);

// Values of shadowReach (render/shadows.glsl), texels: of the nearest depth, of the hardware's mean
// of four, and of comparisons along the surface's plane (PLANE_COMPARISON).
inline constexpr float kNearestReach = 0.5f, kFilteredReach = 1.f, kPlaneReach = 0.35f;

void bindShadowMaps(gpu::Commands& commands, const ShadowMaps& shadowMaps, bool filtered);

}  // namespace lucerna::render
