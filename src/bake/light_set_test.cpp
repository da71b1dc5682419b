// Lights by group, and which of them reach a place.
#include "bake/light_set.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

namespace lucerna::bake {
namespace {

// Distances from a box to a light's surface, the definition.
bool mayReach(const scene::PlacedLight& light, const Aabb& box) {
  const vec3 away = glm::max(glm::max(box.min - light.positionW, light.positionW - box.max), 0.f);
  return light.kind == scene::LightKind::Directional ||
         glm::length(away) < light.reach + light.radius;
}

TEST(ReachTree, FindsAllLightsThatMayReachABoxAndFewOthers) {
  std::mt19937 random(7);
  const auto within = [&](float low, float high) {
    return std::uniform_real_distribution<float>(low, high)(random);
  };
  const auto place = [&] { return vec3(within(-100, 100), within(-10, 10), within(-100, 100)); };
  std::vector<scene::PlacedLight> lights(3000);
  for (scene::PlacedLight& light : lights) {
    light.positionW = place();
    light.reach = within(1, 12);
    light.radius = within(0, 0.5);
  }
  lights[17].kind = scene::LightKind::Directional;
  lights[18].reach = std::numeric_limits<float>::infinity();
  const scene::Bvh tree = reachTree(lights);
  std::size_t all = 0, others = 0;
  for (int i = 0; i < 300; ++i) {
    Aabb box;
    box.grow(place());
    box.max += vec3(within(0, 5));
    std::vector<std::uint32_t> found;
    tree.query(box, found);
    std::ranges::sort(found);
    for (std::uint32_t k = 0; k < lights.size(); ++k) {
      const bool isFound = std::ranges::binary_search(found, k);
      if (mayReach(lights[k], box)) {
        ASSERT_TRUE(isFound);
        ++all;
      } else {
        others += isFound;
      }
    }
  }
  EXPECT_GT(all, 1000u);
  EXPECT_LT(others, all / 2);
}

}  // namespace
}  // namespace lucerna::bake
