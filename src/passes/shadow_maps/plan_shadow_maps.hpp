// Which maps ShadowMaps draws: for which lights, and what each shows. No GL.
#pragma once

#include "passes/shadow_maps/shadow_maps.hpp"

namespace lucerna::passes {

struct ShadowMapPlan {
  std::vector<render::ShadowMaps::Map> maps{};
  std::vector<render::ShadowMaps::Range> ofLight{};  // one a light
  int lampsWithMaps = 0, lampsLeftOut = 0;           // in sight; left out by the budget
};

// bvh: over the boxes of what throws and what catches shadows.
ShadowMapPlan planShadowMaps(const ShadowMaps::Params& params,
                             std::span<const scene::PlacedLight> lights,
                             std::span<const scene::View> views, const scene::Bvh& bvh);

}  // namespace lucerna::passes
