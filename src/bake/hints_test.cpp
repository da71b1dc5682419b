// What counts: what was asked for, the scene's hints, the baker's choice.
#include "bake/hints.hpp"

#include <gmock/gmock.h>

#include "bake/light_scenes.hpp"

namespace lucerna::bake {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// A lamp that is always on and two that switch.
scene::Scene threeLamps() {
  scene::Scene scene = trace::testing::emptyScene();
  for (const char* group : {"", "shop", "desk"})
    testing::addLight(scene, scene::LightKind::Point, {0, 1, 0}, {0, -1, 0}).group = group;
  updateTransforms(scene);
  return scene;
}

BakeSettings settingsOf(const scene::Scene& scene, const Asked& asked = {}) {
  const auto settings = withHints({}, asked, scene);
  EXPECT_TRUE(settings) << settings.error().message;
  return settings ? *settings : BakeSettings();
}

TEST(Hints, WithoutAnyTheBakerChooses) {
  const BakeSettings settings = settingsOf(threeLamps());
  EXPECT_EQ(settings.pack.side, BakeSettings().pack.side);
  EXPECT_FALSE(settings.patchTolerance);
  EXPECT_THAT(settings.groups, IsEmpty());
}

TEST(Hints, CountUnlessOtherwiseAsked) {
  scene::Scene scene = threeLamps();
  scene.bake.mapSize = 512;
  scene.bake.patchTolerance = 0.25f;
  scene.bake.patches = false;
  BakeSettings settings = settingsOf(scene);
  EXPECT_EQ(settings.pack.side, 512);
  EXPECT_EQ(settings.patchTolerance, 0.25f);
  EXPECT_THAT(settings.groups, ElementsAre("always-on"));
  settings = settingsOf(scene, {.side = 256, .patchTolerance = 0.f, .groups = {{"shop"}}});
  EXPECT_EQ(settings.pack.side, 256);
  EXPECT_EQ(settings.patchTolerance, 0.f);
  EXPECT_THAT(settings.groups, ElementsAre("shop"));
  settings = settingsOf(scene, {.side = {}, .patchTolerance = {}, .groups = {{}}});
  EXPECT_THAT(settings.groups, IsEmpty()) << "--lights all";
}

TEST(Hints, WithoutMapsOnlyWhatSwitchesIsBaked) {
  scene::Scene scene = threeLamps();
  scene.bake.maps = false;
  EXPECT_THAT(settingsOf(scene).groups, ElementsAre("desk", "shop"));
}

TEST(Hints, ThatLeaveNothingToBakeAreAnError) {
  scene::Scene scene = threeLamps();
  scene.bake.maps = scene.bake.patches = false;
  const auto neither = withHints({}, {}, scene);
  ASSERT_FALSE(neither);
  EXPECT_EQ(neither.error().kind, ErrorKind::Usage);
  EXPECT_THAT(neither.error().message, HasSubstr("no maps and no patches"));
  scene.bake.patches = true;
  for (scene::Light& light : scene.lights) light.group.clear();
  EXPECT_THAT(withHints({}, {}, scene).error().message, HasSubstr("no light has a group"));
}

}  // namespace
}  // namespace lucerna::bake
