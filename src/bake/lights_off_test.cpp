// Groups of lights switched off in finished lightmaps, beside bakes that never had them: whole
// bakes, read from their files.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bake/bake.hpp"
#include "core/test_folder.hpp"
#include "lightmap/lightmap.hpp"
#include "lightmap/switching.hpp"
#include "scene/load.hpp"

namespace lucerna::bake {
namespace {

constexpr float kSeen = 1.f / 255.f;  // of a white surface's brightness

scene::Scene sceneOf(const std::string& name) {
  Result<scene::Scene> scene = scene::loadScene(name);
  CHECK(scene, "{}", scene.error().message);
  scene::animate(*scene, 0.f);
  return std::move(*scene);
}

// groups: as --lights; empty: all.
lightmap::Lightmap bakeOf(const scene::Scene& scene, float density,
                          std::vector<std::string> groups = {}) {
  BakeSettings settings;
  settings.density = density;
  settings.sampling = kPreview;
  settings.pack.side = 512;
  settings.groups = std::move(groups);
  const Result<Plan> plan = makePlan(scene, settings);
  CHECK(plan, "{}", plan.error().message);
  const TestFolder folder;
  BakeReport report;
  CHECK(prepareFolder(folder.path(), false, {}));
  CHECK(lightShard(*plan, folder.path(), {}, report));
  CHECK(finish(*plan, folder.path(), report));
  Result<lightmap::Lightmap> read = lightmap::readLightmap(folder.path());
  CHECK(read, "{}", read.error().message);
  return std::move(*read);
}

// The maps with every group on but one.
std::vector<Image> mapsWithout(const lightmap::Lightmap& lightmap, const std::string& off) {
  Result<lightmap::SwitchedMaps> maps =
      lightmap::SwitchedMaps::create(lightmap.maps, lightmap.patches);
  CHECK(maps, "{}", maps.error().message);
  for (std::size_t i = 0; i < lightmap.patches.size(); ++i)
    if (lightmap.patches[i].group != off) CHECK(maps->set(i, lightmap.patches[i].color));
  maps->update();
  return maps->maps();
}

// Of brightness, what is above white counts as white.
struct Off {
  float largest = 0.f;
  std::uint64_t seen = 0, lit = 0;  // texels off by more than kSeen; that are not black
};
Off compare(const std::vector<Image>& a, const std::vector<Image>& b, float white) {
  CHECK(a.size() == b.size());
  Off off;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (int y = 0; y < a[i].height(); ++y)
      for (int x = 0; x < a[i].width(); ++x) {
        const float *p = a[i].pixel<float>(x, y), *q = b[i].pixel<float>(x, y);
        float here = 0.f;
        for (int c = 0; c < 3; ++c)
          here =
              std::max(here, std::abs(std::min(p[c] / white, 1.f) - std::min(q[c] / white, 1.f)));
        off.largest = std::max(off.largest, here);
        off.seen += here > kSeen;
        off.lit += p[0] + p[1] + p[2] > 0.f;
      }
  return off;
}

std::vector<std::string> groupsOf(const lightmap::Lightmap& lightmap) {
  std::vector<std::string> names;
  for (const lightmap::Patch& patch : lightmap.patches) names.push_back(patch.group);
  return names;
}

// The scene without a group's lights, where all others are always on.
scene::Scene without(scene::Scene scene, const std::string& group) {
  for (scene::Light& light : scene.lights) {
    if (light.group == group) light.intensity = 0.f;
    light.group.clear();
    light.on = true;
  }
  return scene;
}

// Each `step`-th group off beside a bake of all others (--lights), which is to be the same; the
// last one also beside a bake in which the others are always on. There, seams are closed for all
// light together, and texels inside of solids take the darkest of all together: some of the texels
// there differ.
void expectSame(const scene::Scene& scene, float density, std::size_t groups,
                std::size_t step = 1) {
  const float white = irradianceOfWhite(scene);
  const lightmap::Lightmap all = bakeOf(scene, density);
  const std::vector<std::string> names = groupsOf(all);
  ASSERT_EQ(names.size(), groups);
  const std::vector<Image> on = mapsWithout(all, "");
  for (std::size_t i = 0; i < groups; i += step) {
    const std::string& off = names[i];
    const std::vector<Image> switched = mapsWithout(all, off);
    EXPECT_GT(compare(on, switched, white).largest, 10 * kSeen) << off << " lights nothing";
    std::vector<std::string> others{"always-on"};
    std::ranges::copy_if(names, std::back_inserter(others),
                         [&](const std::string& name) { return name != off; });
    const lightmap::Lightmap baked = bakeOf(scene, density, others);
    EXPECT_LE(compare(switched, mapsWithout(baked, ""), white).largest, kSeen) << off;
  }
  const Off off = compare(mapsWithout(all, names.back()),
                          bakeOf(without(scene, names.back()), density).maps, white);
  EXPECT_LE(static_cast<double>(off.seen), 0.02 * static_cast<double>(off.lit));
}

TEST(LightsOff, LampsOfTheThesisForm) {
  scene::Scene scene = sceneOf(LUCERNA_SOURCE_DIR "/tests/scenes/lamps/lamps.obj");
  for (scene::Light& light : scene.lights)
    if (light.group.empty()) light.group = "porch";
  expectSame(scene, 10.f, 2);
}

TEST(LightsOff, AnAtriumWhoseLampsAreFourGroups) {
  scene::Scene scene = sceneOf("builtin:atrium");
  for (std::size_t i = 0; i < scene.lights.size(); ++i)
    scene.lights[i].group = fmt::format("row-{}", i % 4);
  expectSame(scene, 1.f, 4);
}

TEST(LightsOff, ANightCitysThirteenLamps) {
  scene::Scene scene = sceneOf("builtin:nightcity?blocks=6");
  scene.bake.areaLights = false;   // what always shines takes time and is the same in all bakes
  expectSame(scene, 0.2f, 13, 6);  // all take half a minute and give the same
}

}  // namespace
}  // namespace lucerna::bake
