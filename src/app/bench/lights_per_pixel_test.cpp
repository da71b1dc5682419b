#include "app/bench/lights_per_pixel.hpp"

#include <gmock/gmock.h>

#include "app/bench/statistics.hpp"
#include "scene/load.hpp"

namespace lucerna::app::bench {
namespace {

std::vector<double> countsIn(const std::string& name) {
  auto scene = scene::loadScene(name);
  EXPECT_TRUE(scene);
  return lightsPerPixel(*scene, scene::viewOf(*scene, scene->cameras[0], 1.5f), {30, 20});
}

// All lamps of the ring reach all of the floor, shadows or not.
TEST(LightsPerPixel, AreThoseWithinReach) {
  for (const int lamps : {1, 8}) {
    const auto counts = countsIn(fmt::format("builtin:penumbra?case=overlap&k={}", lamps));
    EXPECT_GT(counts.size(), 300u);
    EXPECT_EQ(quantileOf(counts, 0.5), lamps);
    EXPECT_LE(quantileOf(counts, 1), lamps);
  }
}

TEST(LightsPerPixel, SurfacesThatTurnAwayGetNone) {
  EXPECT_EQ(quantileOf(countsIn("builtin:penumbra?case=pole"), 0), 0) << "the pole's far side";
}

TEST(LightsPerPixel, TheSkyIsNoSurface) {
  EXPECT_LT(countsIn("builtin:nightcity").size(), 30u * 20);
}

}  // namespace
}  // namespace lucerna::app::bench
