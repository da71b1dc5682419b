#include "passes/shadow_maps/plan_shadow_maps.hpp"

#include <gtest/gtest.h>

#include <map>
#include <tuple>

namespace lucerna::passes {
namespace {

using Place = render::ShadowMaps::Place;

constexpr std::uint64_t kMebibyte = std::uint64_t{1} << 20;

// A hall with lamps all over it, and an eye in its middle that sees all of it before it.
struct Hall {
  std::vector<scene::PlacedLight> lights;
  std::vector<scene::View> views{1};
  scene::Bvh bvh;
  bool translucent = false;

  explicit Hall(int lamps) {
    bvh.build(std::vector<Aabb>{{vec3(-20, 0, -20), vec3(20, 10, 20)}});
    for (int i = 0; i < lamps; ++i) {
      scene::PlacedLight& light = lights.emplace_back();
      light.positionW = vec3(-14 + 4 * (i % 8), 5, -14 + 4 * (i / 8 % 8));
      light.intensity = vec3(10);
      light.reach = 15.f;
      light.light = static_cast<std::uint32_t>(i);
    }
    look({0, 5, 60});
  }

  void look(vec3 eye) {
    scene::View& view = views[0];
    view.viewFromWorld = glm::lookAt(eye, eye - vec3(0, 0, 1), vec3(0, 1, 0));
    view.worldFromView = glm::inverse(view.viewFromWorld);
    view.clipFromView = perspectiveReversed(0.9f, 1.6f, 0.1f, 2000.f);
  }

  ShadowMapPlan plan(const ShadowMaps::Params& params, LampMaps& former) const {
    return planShadowMaps(params, lights, views, {bvh, translucent}, former);
  }
};

std::uint64_t bytesOf(const render::ShadowMapSize& size) {
  return std::uint64_t{4} * static_cast<std::uint64_t>(size.side) *
         static_cast<std::uint64_t>(size.side) * static_cast<std::uint64_t>(size.layers);
}

void expectApart(const ShadowMapPlan& plan) {
  for (std::size_t i = 0; i < plan.maps.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      ASSERT_FALSE(plan.maps[i].place.overlaps(plan.maps[j].place)) << i << " and " << j;
}

TEST(PlanShadowMaps, SixtyFourPointLightsFitTheMemoryOfTheDefaults) {
  Hall hall(64);
  hall.look({0, 5, 19});
  LampMaps former;
  const ShadowMaps::Params params;
  const ShadowMapPlan plan = hall.plan(params, former);
  EXPECT_EQ(plan.lampsWithMaps, 64);
  EXPECT_EQ(plan.lampsOverCount + plan.lampsOverMemory, 0);
  EXPECT_GT(plan.maps.size(), 300u) << "nearly all faces see something";
  EXPECT_LE(bytesOf(plan.local), 512 * kMebibyte);
  expectApart(plan);
}

TEST(PlanShadowMaps, LampsShrinkToTheirMemoryAndOnlyThenAreLeftOut) {
  const Hall hall(256);
  for (const int memory : {1, 8, 64, 600}) {
    LampMaps former;
    const ShadowMapPlan plan = hall.plan({.localLights = 256, .localMemory = memory}, former);
    EXPECT_LE(bytesOf(plan.local), static_cast<std::uint64_t>(memory) * kMebibyte);
    EXPECT_EQ(plan.lampsWithMaps + plan.lampsOverMemory, 256);
    EXPECT_EQ(plan.lampsOverMemory > 0, memory < 24) << "256 lamps, six faces, 64 texels";
    expectApart(plan);
  }
}

// Four times as many bytes for each texel.
TEST(PlanShadowMaps, TranslucentSurfacesTakeTheirMemory) {
  Hall hall(64);
  hall.translucent = true;
  LampMaps former;
  const ShadowMapPlan plan = hall.plan({}, former);
  EXPECT_EQ(plan.lampsWithMaps, 64);
  EXPECT_LE(4 * bytesOf(plan.local), 512 * kMebibyte);
  EXPECT_GT(4 * bytesOf(plan.local), 256 * kMebibyte);
}

TEST(PlanShadowMaps, AMapIsNeverLargerThanTheMemory) {
  const Hall hall(1);
  LampMaps former;
  const ShadowMapPlan plan = hall.plan({.localSize = 8192, .localMemory = 16}, former);
  EXPECT_EQ(plan.local.side, 2048);
  EXPECT_EQ(plan.lampsWithMaps, 1);
}

// By light and axis.
using Places = std::map<std::tuple<std::size_t, float, float, float>, Place>;
Places placesOf(const ShadowMapPlan& plan) {
  Places places;
  for (std::size_t light = 0; light < plan.ofLight.size(); ++light)
    for (std::uint32_t i = 0; i < plan.ofLight[light].count; ++i) {
      const render::ShadowMaps::Map& map = plan.maps[plan.ofLight[light].first + i];
      const vec3 axis = glm::transpose(map.projection.viewFromWorld)[2];
      places[{light, axis.x, axis.y, axis.z}] = map.place;
    }
  return places;
}

TEST(PlanShadowMaps, MapsKeepTheirPlacesUnderAStillCamera) {
  const Hall hall(64);
  LampMaps former;
  const Places first = placesOf(hall.plan({}, former));
  EXPECT_EQ(first.size(), 64u * 6u);
  EXPECT_TRUE(placesOf(hall.plan({}, former)) == first);
}

// On the way to the lamps, 10 cm to and fro at each step, sizes grow and never fall, and a map
// whose size stays has its place but for the few times when all are placed anew.
TEST(PlanShadowMaps, MapsKeepTheirPlacesUnderAMovingCamera) {
  Hall hall(64);
  LampMaps former;
  Places before;
  int stayed = 0, moved = 0, grown = 0, shrunk = 0;
  for (float z = 120.f; z > 10.f; z -= 1.f)
    for (const float by : {0.f, 0.1f, -0.1f, 0.1f}) {
      hall.look({0, 5, z + by});
      Places places = placesOf(hall.plan({}, former));
      for (const auto& [map, place] : places) {
        const auto found = before.find(map);
        if (found == before.end()) continue;
        const int side = found->second.side;
        ++(place == found->second ? stayed
           : place.side > side    ? grown
           : place.side < side    ? shrunk
                                  : moved);
      }
      before = std::move(places);
    }
  EXPECT_EQ(shrunk, 0);
  EXPECT_GT(grown, 0);
  EXPECT_LT(moved, stayed / 100);
}

TEST(PlanShadowMaps, FarLampsHaveSmallMaps) {
  Hall hall(1);
  LampMaps former;
  for (const auto& [distance, side] :
       {std::pair(10.f, 512), std::pair(80.f, 256), std::pair(160.f, 128), std::pair(1000.f, 64)}) {
    hall.look(hall.lights[0].positionW + vec3(0, 0, distance));
    const ShadowMapPlan plan = hall.plan({}, former);
    ASSERT_FALSE(plan.maps.empty());
    EXPECT_EQ(plan.maps[0].place.side, side) << distance << " m";
  }
}

}  // namespace
}  // namespace lucerna::passes
