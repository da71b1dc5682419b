// Which maps ShadowMaps draws: for which lights, and what each shows. No GL.
#pragma once

#include "passes/shadow_maps/shadow_maps.hpp"

namespace lucerna::passes {

struct ShadowMapPlan {
  std::vector<render::ShadowMaps::Map> maps{};
  std::vector<render::ShadowMaps::Range> ofLight{};  // one a light
  render::ShadowMapSize directional{}, local{};      // without remedies
  // Lamps in sight: with maps, and those for which localLights or localMemory leaves none.
  int lampsWithMaps = 0, lampsOverCount = 0, lampsOverMemory = 0;
};

struct Surfaces {
  const scene::Bvh& bvh;     // over the boxes of what throws and what catches shadows
  bool translucent = false;  // there are some that colour the light
};

// former: what the last frame's plan left there; empty at first.
ShadowMapPlan planShadowMaps(const ShadowMaps::Params& params,
                             std::span<const scene::PlacedLight> lights,
                             std::span<const scene::View> views, const Surfaces& surfaces,
                             LampMaps& former);

}  // namespace lucerna::passes
