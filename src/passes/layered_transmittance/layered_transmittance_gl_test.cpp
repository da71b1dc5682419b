// Coloured penumbrae in layers against what is known of them. What panes do whatever filters them:
// passes/shadow_maps/panes_gl_test.cpp.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/testing.hpp"

namespace lucerna {
namespace {

constexpr float kWall = 6.f;  // m before the camera
constexpr float kOpacity = 0.3f;
const vec3 kRedGlass{1.f, 0.3f, 0.2f}, kGreenGlass{0.3f, 1.f, 0.4f}, kBlueGlass{0.3f, 0.5f, 1.f};

void addPane(scene::Scene& scene, vec3 transmission, vec3 middle, vec2 sides) {
  scene::Material& glass = scene.materials.emplace_back();
  glass.alphaMode = scene::AlphaMode::Blend;
  glass.albedo = vec4(0.2f, 0.2f, 0.2f, kOpacity);
  glass.transmission = transmission;
  // One face of a thin box lets light in; the other, by which it leaves, does not count.
  testing::addBox(scene, middle, vec3(sides, 1e-3f),
                  static_cast<std::uint32_t>(scene.materials.size() - 1));
}

void addLamp(scene::Scene& scene, scene::LightKind kind, vec3 eye, vec3 target, float radius) {
  scene::Light light;
  light.kind = kind;
  light.intensity = kind == scene::LightKind::Directional ? 1.f : 20.f;
  light.outerCone = 1.f;
  light.innerCone = 0.9f;
  light.radius = radius;
  light.angle = 0.05f;
  testing::addLight(scene, light, eye, target);
}

scene::Scene wallScene() {
  scene::Scene scene = testing::emptyScene();
  testing::addWall(scene, kWall);
  return scene;
}

const std::vector<std::string> kRows{
    "Cull",         "GBuffer",         "ShadowMaps", "TileLights", "ShadowLayers",
    "ShadowMask",   "NearestBlockers", "Penumbra",   "ShadowBlur", "LayeredTransmittance",
    "TiledLighting"};

graph::PassRow& rowOf(graph::Pipeline& pipeline, const std::string& type) {
  return *std::ranges::find(pipeline.passes, type, &graph::PassRow::type);
}

struct Case {
  std::string method = "search", resolution = "half";
};

graph::Pipeline layeredRows(const Case& of = {}, bool withPass = true) {
  std::vector<std::string> types = kRows;
  if (of.method == "search") std::erase(types, "NearestBlockers");
  graph::Pipeline pipeline = testing::rows(types);
  rowOf(pipeline, "ShadowMaps").params["localSize"] = std::int64_t{2048};
  rowOf(pipeline, "ShadowLayers").params["layers"] = std::int64_t{32};
  rowOf(pipeline, "LayeredTransmittance").params = {{"method", of.method},
                                                    {"resolution", of.resolution},
                                                    {"search", std::int64_t{11}},
                                                    {"kernel", std::int64_t{23}}};
  rowOf(pipeline, "LayeredTransmittance").enabled = withPass;
  rowOf(pipeline, "TiledLighting").params["shadows"] = std::string("layered");
  return pipeline;
}

Image pictureOf(const scene::Scene& scene, const graph::Pipeline& pipeline, uvec2 size) {
  return testing::asFloatRgb(testing::valueOf(scene, pipeline, size, "TiledLighting.color"));
}

class PanesInLayers : public ::testing::TestWithParam<Case> {
 protected:
  void TearDown() override { testing::expectNoDebugMessages(); }
};
INSTANTIATE_TEST_SUITE_P(By, PanesInLayers,
                         ::testing::Values(Case{"search", "half"}, Case{"search", "full"},
                                           Case{"minimum", "half"}, Case{"minimum", "full"}),
                         [](const auto& parameter) {
                           return parameter.param.method + "_" + parameter.param.resolution;
                         });

// A spot lamp, a disc, beside the camera and a pane that covers half of all, half way to the wall.
TEST_P(PanesInLayers, HavePenumbraeOfTheRightWidth) {
  constexpr uvec2 kPicture{513, 129};
  constexpr float kLampX = -1.f, kEdgeX = 0.f;
  for (const float radius : {0.2f, 0.4f, 0.8f}) {
    SCOPED_TRACE(radius);
    scene::Scene scene = wallScene();
    addLamp(scene, scene::LightKind::Spot, {kLampX, 0.5f, 0}, {kLampX, 0.5f, -kWall}, radius);
    updateTransforms(scene);
    const graph::Pipeline pipeline = layeredRows(GetParam());
    const Image lit = pictureOf(scene, pipeline, kPicture);
    addPane(scene, kRedGlass, {kEdgeX - 20.f, 0, -0.5f * kWall}, vec2(40));
    updateTransforms(scene);
    const Image found = pictureOf(scene, pipeline, kPicture);
    const vec3 through = scene::transmittance(kOpacity, kRedGlass);
    const float aspect = static_cast<float>(kPicture.x) / static_cast<float>(kPicture.y);
    const float width = 2.f * kWall * std::tan(0.5f * scene.cameras[0].fovY) * aspect;  // m
    const float middle = kEdgeX + (kEdgeX - kLampX);  // as far behind the edge as before it
    double worst = 0;
    int within = 0;
    for (int x = kPicture.x / 2 + 2; x < static_cast<int>(kPicture.x); ++x) {
      const float at = width * ((static_cast<float>(x) + 0.5f) / kPicture.x - 0.5f);
      const double share = testing::visibleShareOfDisc((at - middle) / radius);
      const int y = kPicture.y / 2;
      for (int c = 0; c < 3; ++c) {
        const double color = found.pixel<float>(x, y)[c] / lit.pixel<float>(x, y)[c];
        worst = std::max(worst, std::abs((color - through[c]) / (1. - through[c]) - share));
      }
      within += std::abs(at - middle) < radius;
    }
    EXPECT_GT(within, 3);
    EXPECT_LT(worst, 0.12);
  }
}

// Panes that overlap before lamps that do, of all kinds: each lamp has the colours it has alone.
TEST_P(PanesInLayers, OfLampsTogetherAreThoseOfEachAlone) {
  constexpr uvec2 kPicture{96, 64};
  constexpr std::size_t kLamps = 18;  // more than are looked up at once
  scene::Scene scene = wallScene();
  addPane(scene, kRedGlass, {-0.3f, 0, -4}, {0.9f, 1.2f});
  addPane(scene, kGreenGlass, {0, 0.3f, -3.5f}, {0.8f, 0.4f});
  addPane(scene, kBlueGlass, {0.3f, 0, -4.4f}, {0.9f, 1.f});
  testing::addBox(scene, {0, -0.3f, -4.2f}, vec3(0.3f));
  for (std::size_t i = 0; i < kLamps; ++i) {
    const float turn = 2.f * kPi * static_cast<float>(i) / kLamps;
    const auto kind = i == 0       ? scene::LightKind::Directional
                      : i % 3 == 0 ? scene::LightKind::Point
                                   : scene::LightKind::Spot;
    addLamp(scene, kind, {1.5f * std::cos(turn), std::sin(turn), -1.f}, {0, 0, -kWall}, 0.1f);
  }
  updateTransforms(scene);
  graph::Pipeline pipeline = layeredRows(GetParam());
  // Larger ones do not all fit, and those of a lamp alone would differ.
  rowOf(pipeline, "ShadowMaps").params["localSize"] = std::int64_t{512};
  testing::expectSumOfEachLightAlone(scene, [&] { return pictureOf(scene, pipeline, kPicture); });
}

// Edges of panes among each other, drawn first to last and last to first.
TEST_P(PanesInLayers, AreTheSameInAnyOrder) {
  constexpr uvec2 kPicture{96, 64};
  struct Pane {
    vec3 transmission, middle;
  };
  std::vector<Pane> panes{{kRedGlass, {-0.2f, 0, -3}},
                          {kGreenGlass, {0.1f, 0.2f, -3.5f}},
                          {kBlueGlass, {0.2f, -0.1f, -4}}};
  std::vector<Image> pictures;
  for (int turn = 0; turn < 2; ++turn) {
    scene::Scene scene = wallScene();
    for (const Pane& pane : panes) addPane(scene, pane.transmission, pane.middle, vec2(0.8f));
    addLamp(scene, scene::LightKind::Spot, {0, 0.3f, 0}, {0, 0, -kWall}, 0.2f);
    addLamp(scene, scene::LightKind::Directional, {1, 1, 1}, {0, 0, -kWall}, 0.f);
    updateTransforms(scene);
    pictures.push_back(pictureOf(scene, layeredRows(GetParam()), kPicture));
    std::ranges::reverse(panes);
  }
  EXPECT_TRUE(std::ranges::equal(pictures[0].bytes(), pictures[1].bytes()));
}

// A card that the lamp sees before the pane, in front of a wall that is tinted all over: colours of
// the one do not run into the other, however wide penumbrae are.
TEST_P(PanesInLayers, DoNotRunAcrossEdges) {
  constexpr uvec2 kPicture{160, 120};
  scene::Scene scene = wallScene();
  testing::addBox(scene, {0.1f, 0, -1}, {0.3f, 0.4f, 1e-3f});
  addLamp(scene, scene::LightKind::Spot, {-3, 0, 0}, {0, 0, -kWall}, 0.4f);
  updateTransforms(scene);
  const graph::Pipeline pipeline = layeredRows(GetParam());
  const Image bare = pictureOf(scene, pipeline, kPicture);
  addPane(scene, kRedGlass, {0, 0, -3}, vec2(40));
  updateTransforms(scene);
  const Image found = pictureOf(scene, pipeline, kPicture);
  const float through = scene::transmittance(kOpacity, kRedGlass).y;
  int tinted = 0, clear = 0, neither = 0;
  for (std::size_t i = 1; i < found.as<float>().size(); i += 3) {
    if (bare.as<float>()[i] < 0.01f) continue;
    const float share = found.as<float>()[i] / bare.as<float>()[i];
    const bool likePane = std::abs(share - through) < 0.02f, likeNone = std::abs(share - 1) < 0.02f;
    tinted += likePane, clear += likeNone, neither += !likePane && !likeNone;
  }
  EXPECT_GT(tinted, 1000);
  EXPECT_GT(clear, 1000);
  EXPECT_EQ(neither, 0);
}

// A lamp as good as a point has no penumbrae: pixels are as sharp as the maps are.
TEST_P(PanesInLayers, OfPointsAreAsSharpAsTheMaps) {
  constexpr uvec2 kPicture{128, 96};
  scene::Scene scene = wallScene();
  addPane(scene, kBlueGlass, {0, 0, -3}, vec2(0.7f));
  addLamp(scene, scene::LightKind::Spot, {0.5f, 0.4f, 0}, {0, 0, -kWall}, 1e-4f);
  updateTransforms(scene);
  const graph::Pipeline pipeline = layeredRows(GetParam());
  const Image found = pictureOf(scene, pipeline, kPicture);
  const Image sharp = pictureOf(scene, layeredRows({}, false), kPicture);
  int differ = 0;
  for (std::size_t i = 0; i < found.as<float>().size(); ++i)
    differ += std::abs(found.as<float>()[i] - sharp.as<float>()[i]) >
              0.01f * std::max(sharp.as<float>()[i], 0.01f);
  EXPECT_LT(differ, GetParam().resolution == "half" ? 1 : 20);
}

// Where nothing is translucent the pass is as if it were not there.
TEST(LayeredTransmittance, CostsNothingWithoutPanes) {
  constexpr uvec2 kPicture{96, 64};
  scene::Scene scene = wallScene();
  testing::addBox(scene, {0, 0, -4}, vec3(0.7f));
  for (const float x : {-1.f, 1.f})
    addLamp(scene, scene::LightKind::Spot, {x, 0, -1}, {0, 0, -kWall}, 0.1f);
  addPane(scene, kRedGlass, {500, 0, -4}, vec2(1));  // out of the light's way
  updateTransforms(scene);
  struct Frame {
    Image picture;
    gpu::Counters counters;
    std::uint64_t textureBytes = 0;
  };
  const auto drawn = [&](bool withPass) {
    const gpu::ObjectCounts before = testing::device().objectCounts();
    testing::SceneRenderer renderer(scene);
    const graph::Pipeline pipeline = layeredRows({}, withPass);
    EXPECT_TRUE(renderer.render(pipeline, kPicture, {"TiledLighting.color"}));
    testing::device().resetCounters();
    auto output = renderer.render(pipeline, kPicture, {"TiledLighting.color"});
    return Frame{output ? output->kept.at("TiledLighting.color") : Image(),
                 testing::device().counters(),
                 testing::device().objectCounts().textureBytes - before.textureBytes};
  };
  const Frame with = drawn(true), without = drawn(false);
  EXPECT_TRUE(std::ranges::equal(with.picture.bytes(), without.picture.bytes()));
  EXPECT_EQ(with.counters.draws, without.counters.draws);
  EXPECT_EQ(with.counters.targetSwitches, without.counters.targetSwitches);
  EXPECT_EQ(with.textureBytes, without.textureBytes);
  testing::expectNoDebugMessages();
}

// Many lamps, few of which see panes: the others take no memory, and lose no colour.
TEST(LayeredTransmittance, TakesMemoryOfLayersWithPanesAlone) {
  constexpr uvec2 kPicture{96, 64};
  struct Frame {
    std::uint64_t bytes = 0;
    vec3 center{0.f};
  };
  const auto drawn = [&](int lamps, bool withPass) {
    scene::Scene scene = wallScene();
    addPane(scene, kRedGlass, {0, 1.5f, -0.5f}, vec2(0.5f));
    // One stands before the pane and all others behind it.
    for (int i = 0; i < lamps; ++i)
      addLamp(scene, scene::LightKind::Spot, {0, 1.5f, i == 0 ? 0.f : -1.f}, {0, 0, -kWall}, 0.1f);
    updateTransforms(scene);
    const std::uint64_t before = testing::device().objectCounts().textureBytes;
    testing::SceneRenderer renderer(scene);
    auto output = renderer.render(layeredRows({}, withPass), kPicture, {"TiledLighting.color"});
    EXPECT_TRUE(output);
    return Frame{testing::device().objectCounts().textureBytes - before,
                 output ? testing::centerOf(output->kept.at("TiledLighting.color")) : vec3(0)};
  };
  const Frame with = drawn(9, true), without = drawn(9, false);
  const std::uint64_t one = drawn(1, true).bytes - drawn(1, false).bytes;
  EXPECT_GT(one, 0u);
  EXPECT_EQ(with.bytes - without.bytes, one);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(with.center[c], without.center[c], 0.01f * with.center.x);
  testing::expectNoDebugMessages();
}

// Lights for which no layer is left are coloured by their maps.
TEST(LayeredTransmittance, LeavesLightsWithoutALayerToTheirMaps) {
  constexpr uvec2 kPicture{65, 65};
  scene::Scene scene = wallScene();
  for (const float x : {-0.2f, 0.2f})
    addLamp(scene, scene::LightKind::Spot, {x, 0, 0}, {0, 0, -kWall}, 0.1f);
  updateTransforms(scene);
  graph::Pipeline pipeline = layeredRows();
  rowOf(pipeline, "ShadowLayers").params["layers"] = std::int64_t{1};
  const auto center = [&] {
    const Image picture = pictureOf(scene, pipeline, kPicture);
    const float* pixel = picture.pixel<float>(picture.width() / 2, picture.height() / 2);
    return vec3(pixel[0], pixel[1], pixel[2]);
  };
  const vec3 bare = center();
  addPane(scene, kGreenGlass, {0, 0, -3}, vec2(2));
  updateTransforms(scene);
  const vec3 share = center() / bare, wanted = scene::transmittance(kOpacity, kGreenGlass);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(share[c], wanted[c], 0.02f * wanted[c]);
  testing::expectNoDebugMessages();
}

}  // namespace
}  // namespace lucerna
