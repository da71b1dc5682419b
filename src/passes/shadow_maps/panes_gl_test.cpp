// Light through translucent surfaces: its colour on what lies behind them, and only there.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "support/testing.hpp"

namespace lucerna {
namespace {

constexpr uvec2 kSize{65, 65};  // odd: the middle pixel looks along the axis
constexpr float kWall = 6.f;    // m before the camera

const vec4 kRed{0.5f, 0.1f, 0.1f, 0.25f}, kBlue{0.1f, 0.2f, 0.5f, 0.4f};  // albedo, opacity
const vec3 kRedGlass{1.f, 0.3f, 0.2f}, kBlueGlass{0.3f, 0.5f, 1.f};       // what they let through

struct Case {
  std::string name;
  scene::LightKind kind;
  std::string method, shadows;
};
std::vector<Case> cases() {
  std::vector<Case> all;
  for (const std::string shadows : {"hard", "pcf", "pcss", "layered"}) {
    all.push_back({"Lispsm_" + shadows, scene::LightKind::Directional, "lispsm", shadows});
    all.push_back({"Cascades_" + shadows, scene::LightKind::Directional, "cascades", shadows});
    all.push_back({"Spot_" + shadows, scene::LightKind::Spot, "lispsm", shadows});
    all.push_back({"Point_" + shadows, scene::LightKind::Point, "lispsm", shadows});
  }
  return all;
}

std::uint32_t addGlass(scene::Scene& scene, vec4 albedo, vec3 transmission) {
  scene::Material& glass = scene.materials.emplace_back();
  glass.alphaMode = scene::AlphaMode::Blend;
  glass.albedo = albedo;
  glass.transmission = transmission;
  return static_cast<std::uint32_t>(scene.materials.size() - 1);
}

// A pane across the light's way from behind the camera: one face of a thin box lets light in, and
// the other, which it leaves by the back, does not count.
void addPane(scene::Scene& scene, std::uint32_t material, float z, float side = 1.f) {
  testing::addBox(scene, {0, 0, z}, {side, side, 0.02f}, material);
}

void addLamp(scene::Scene& scene, scene::LightKind kind) {
  scene::Light light;
  light.kind = kind;
  light.intensity = kind == scene::LightKind::Directional ? kPi : 100.f;
  light.outerCone = 1.f;
  light.innerCone = 0.9f;
  light.radius = 0.05f;
  light.angle = 0.01f;
  testing::addLight(scene, light, {0, 0, 4}, {0, 0, -1});
  updateTransforms(scene);
}

scene::Scene wallScene() {
  scene::Scene scene = testing::emptyScene();
  testing::addWall(scene, kWall);
  return scene;
}

class Panes : public ::testing::TestWithParam<Case> {
 protected:
  void TearDown() override { testing::expectNoDebugMessages(); }
  Image picture(const scene::Scene& scene) const {
    std::vector<std::string> types{"Cull", "GBuffer", "ShadowMaps", "TiledLighting"};
    if (GetParam().shadows == "layered")
      types.insert(types.end() - 1, {"TileLights", "ShadowLayers", "ShadowMask", "Penumbra",
                                     "ShadowBlur", "LayeredTransmittance"});
    graph::Pipeline pipeline = testing::rows(types);
    pipeline.passes[2].params["method"] = GetParam().method;
    pipeline.passes.back().params["shadows"] = GetParam().shadows;
    pipeline.passes.back().params["kernel"] = std::int64_t{5};
    return testing::valueOf(scene, pipeline, kSize, "TiledLighting.color");
  }
  vec3 center(const scene::Scene& scene) const { return testing::centerOf(picture(scene)); }
};
INSTANTIATE_TEST_SUITE_P(Of, Panes, ::testing::ValuesIn(cases()),
                         [](const auto& parameter) { return parameter.param.name; });

// Half a percent: half floats, and a step of halvings for each pane. In layers one percent: steps
// of a dark colour's square root.
void expectShare(vec3 found, vec3 wanted, const char* what) {
  const float share = Panes::GetParam().shadows == "layered" ? 0.01f : 0.005f;
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], wanted[c], share * wanted[c]) << what << c;
}

TEST_P(Panes, LightBehindThemIsTheProductOfWhatTheyLetThrough) {
  scene::Scene scene = wallScene();
  addLamp(scene, GetParam().kind);
  const vec3 bare = center(scene);
  ASSERT_GT(bare.y, 0.01f);
  const std::uint32_t red = addGlass(scene, kRed, kRedGlass);
  const std::uint32_t blue = addGlass(scene, kBlue, kBlueGlass);
  addPane(scene, red, 2.f);
  updateTransforms(scene);
  const vec3 throughRed = scene::transmittance(kRed.w, kRedGlass);
  expectShare(center(scene) / bare, throughRed, "one pane, ");
  addPane(scene, blue, 1.f);
  updateTransforms(scene);
  expectShare(center(scene) / bare, throughRed * scene::transmittance(kBlue.w, kBlueGlass),
              "two panes, ");
}

// Whichever lies nearer to the light, and whichever is drawn first.
TEST_P(Panes, TheirOrderIsNoMatter) {
  std::vector<Image> pictures;
  for (const bool redFirst : {true, false})
    for (const bool redNearer : {true, false}) {
      scene::Scene scene = wallScene();
      addLamp(scene, GetParam().kind);
      const auto add = [&](bool red) {
        const std::uint32_t glass =
            red ? addGlass(scene, kRed, kRedGlass) : addGlass(scene, kBlue, kBlueGlass);
        addPane(scene, glass, red == redNearer ? 2.f : 1.f, 20.f);
      };
      add(redFirst);
      add(!redFirst);
      updateTransforms(scene);
      pictures.push_back(picture(scene));
    }
  EXPECT_LT(testing::centerOf(pictures[0]).y, testing::centerOf(pictures[0]).x);
  for (const Image& other : pictures)
    EXPECT_TRUE(std::ranges::equal(other.bytes(), pictures[0].bytes()));
}

// A cube before a large pane, as the light sees them: its edges are among the filters' taps.
TEST_P(Panes, WhatLiesBeforeThemIsNotTinted) {
  scene::Scene scene = wallScene();
  testing::addBox(scene, {0, 0, -3}, vec3(1));
  addLamp(scene, GetParam().kind);
  const Image bare = picture(scene);
  addPane(scene, addGlass(scene, kRed, kRedGlass), -4.f, 8.f);
  updateTransforms(scene);
  const Image found = picture(scene);
  const float half = 0.5f / 2.5f;  // of the cube's near face, and of the picture at 1 m
  const vec4 corner = viewOf(scene, scene.cameras[0], 1.f).clipFromView * vec4(half, half, -1, 1);
  const int reach = static_cast<int>(corner.x / corner.w * 0.5f * static_cast<float>(kSize.x)) - 1;
  ASSERT_GT(reach, 5);
  const int middle = static_cast<int>(kSize.x) / 2;
  for (int y = middle - reach; y <= middle + reach; ++y)
    for (int x = middle - reach; x <= middle + reach; ++x)
      ASSERT_EQ(testing::colorAt(found, x, y), testing::colorAt(bare, x, y)) << x << ", " << y;
  EXPECT_LT(testing::colorAt(found, 2, middle).y, 0.9f * testing::colorAt(bare, 2, middle).y);
}

TEST_P(Panes, SunAndPointTogetherAreTheirSum) {
  const auto lit = [&](bool sun, bool lamp) {
    scene::Scene scene = wallScene();
    addPane(scene, addGlass(scene, kBlue, kBlueGlass), 1.f);
    if (sun) addLamp(scene, scene::LightKind::Directional);
    if (lamp) addLamp(scene, scene::LightKind::Point);
    updateTransforms(scene);
    return center(scene);
  };
  const vec3 sum = lit(true, false) + lit(false, true);
  expectShare(lit(true, true), sum, "channel ");
}

// An opaque surface before or behind a pane blocks all; a pane's back face lets all through.
TEST_P(Panes, OpaqueSurfacesBlockAndBackFacesDoNotCount) {
  scene::Scene scene = wallScene();
  addLamp(scene, GetParam().kind);
  const vec3 bare = center(scene);
  const std::uint32_t red = addGlass(scene, kRed, kRedGlass);
  addPane(scene, red, 1.f);
  scene.materials[red].doubleSided = true;  // both faces of the box
  updateTransforms(scene);
  const vec3 once = scene::transmittance(kRed.w, kRedGlass);
  expectShare(center(scene) / bare, once * once, "both faces, ");
  for (const float z : {0.f, 2.f}) {
    scene::Scene blocked = scene;
    testing::addBox(blocked, {0, 0, z}, vec3(0.5f));
    updateTransforms(blocked);
    EXPECT_EQ(center(blocked), vec3(0.f));
  }
}

// Scenes without translucent surfaces pay nothing.
TEST(PanesMemory, IsTakenOnlyWhereAMapSeesSome) {
  const auto bytesOf = [](bool glass, float x) {
    scene::Scene scene = wallScene();
    addLamp(scene, scene::LightKind::Directional);
    if (glass) testing::addBox(scene, {x, 0, 1}, vec3(0.5f), addGlass(scene, kRed, kRedGlass));
    updateTransforms(scene);
    const std::uint64_t before = testing::device().objectCounts().textureBytes;
    testing::SceneRenderer renderer(scene);
    EXPECT_TRUE(renderer.render(testing::rows({"Cull", "GBuffer", "ShadowMaps", "TiledLighting"}),
                                kSize, {"TiledLighting.color"}));
    return testing::device().objectCounts().textureBytes - before;
  };
  constexpr std::uint64_t kMap = 2048u * 2048u;
  const std::uint64_t without = bytesOf(false, 0.f);
  EXPECT_LT(without, 5 * kMap);
  EXPECT_EQ(bytesOf(true, 500.f), without) << "out of the light's way";
  EXPECT_GE(bytesOf(true, 0.f), 16 * kMap);
}

}  // namespace
}  // namespace lucerna
