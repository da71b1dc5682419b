#include "bake/bare_rays.hpp"

#include <gtest/gtest.h>

#include "scene/load.hpp"

namespace lucerna::bake {
namespace {

void add(ShadowRays& rays, vec3 from, vec3 to) {
  const std::size_t i = rays.size();
  rays.resize(i + 1);
  rays.fromX[i] = from.x, rays.fromY[i] = from.y, rays.fromZ[i] = from.z;
  rays.toX[i] = to.x, rays.toY[i] = to.y, rays.toZ[i] = to.z;
}

// Lists that fill no packet: none of the other lanes counts.
TEST(BareRays, BothWaysFindWhatTheTracerFinds) {
  const scene::Scene scene = *scene::loadScene("builtin:cornell");
  const World world = makeWorld(scene);
  Aabb box;
  for (const vec3 p : world.positions) box.grow(p);
  std::vector<ShadowRays> lists(3);
  const std::array<int, 3> lengths{1, 16, 37};
  std::size_t blocked = 0, count = 0;
  for (std::size_t list = 0; list < lists.size(); ++list) {
    for (int i = 0; i < lengths[list]; ++i) {
      const vec3 t(static_cast<float>(i * 7 % 11) / 11.f, static_cast<float>(i * 5 % 13) / 13.f,
                   static_cast<float>(i * 3 % 7) / 7.f);
      add(lists[list], glm::mix(box.min, box.max, 0.1f + 0.8f * t),
          glm::mix(box.max, box.min, 0.15f + 0.6f * vec3(t.y, t.z, t.x)));
    }
    std::vector<vec3> shares(lists[list].size());
    makeEmbreeTracer(world)->trace(lists[list], shares);
    blocked += static_cast<std::size_t>(std::ranges::count(shares, vec3(0.f)));
    count += shares.size();
  }
  ASSERT_GT(blocked, 5u);
  ASSERT_LT(blocked, count);
  for (const BareSettings& settings : {BareSettings{}, likeTracer()}) {
    BareRays bare(world, lists, settings);
    EXPECT_EQ(bare.count(), count);
    for (int round = 0; round < 2; ++round) {  // the first leaves nothing behind
      bare.packetSeconds();
      EXPECT_EQ(bare.blocked(), blocked);
      bare.singleSeconds();
      EXPECT_EQ(bare.blocked(), blocked);
    }
  }
}

}  // namespace
}  // namespace lucerna::bake
