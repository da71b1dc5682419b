#include "app/bench/stage.hpp"

#include <gmock/gmock.h>

#include "image/metrics.hpp"
#include "trace/reference.hpp"

namespace lucerna::app::bench {
namespace {

using testing::HasSubstr;

constexpr uvec2 kSize{96, 72};

std::unique_ptr<Stage> open(const std::string& scene, Surfaces surfaces = Surfaces::Own,
                            Lighting lighting = Lighting::Sun) {
  StageSettings settings{.render = {}, .lighting = lighting, .surfaces = surfaces};
  settings.render.scene = scene;
  auto stage = Stage::open(settings);
  EXPECT_TRUE(stage) << stage.error().message;
  return stage ? std::move(*stage) : nullptr;
}

void lookFromSomewhere(Stage& stage, std::uint64_t seed = 0) {
  const SeededCamera camera = seededCameras(stage.scene(), {.count = 1, .seed = seed})[0];
  const Status looked = stage.look(camera.pose, camera.sight);
  EXPECT_TRUE(looked) << looked.error().message;
}

const Chain kDeferred{{{"Cull"}, {"GBuffer"}, {"TiledLighting"}, {"Background"}, {"ToneMap"}}};

TEST(Stage, VariantsDoNotDisturbEachOther) {
  const auto stage = open("builtin:cornell");
  ASSERT_TRUE(stage);
  const auto first = stage->add({.chain = kDeferred, .size = kSize});
  Chain dark = kDeferred;
  dark.rows.back().settings = {"exposure=-8"};
  const auto second = stage->add({.chain = dark, .size = 2u * kSize, .profiled = true});
  ASSERT_TRUE(first && second);
  lookFromSomewhere(*stage);
  Image before, other, after;
  ASSERT_TRUE(stage->draw(*first, &before));
  ASSERT_TRUE(stage->draw(*second, &other));
  ASSERT_TRUE(stage->draw(*first, &after));
  EXPECT_EQ(before.width(), 96);
  EXPECT_EQ(other.width(), 192);
  EXPECT_TRUE(std::ranges::equal(before.bytes(), after.bytes()));
}

TEST(Stage, ASampleHasTimesAndCounts) {
  const auto stage = open("builtin:cornell");
  ASSERT_TRUE(stage);
  const auto whole = stage->add({.chain = kDeferred, .size = kSize});
  const auto profiled = stage->add({.chain = kDeferred, .size = kSize, .profiled = true});
  ASSERT_TRUE(whole && profiled);
  lookFromSomewhere(*stage);
  const auto frame = stage->draw(*whole), passes = stage->draw(*profiled);
  ASSERT_TRUE(frame && passes);
  EXPECT_GT(frame->cpuMs, 0);
  EXPECT_GE(frame->realMs, frame->cpuMs);
  EXPECT_TRUE(frame->profile.steps.empty());
  EXPECT_EQ(passes->profile.steps.size(), kDeferred.rows.size());
  EXPECT_EQ(frame->counters.draws, passes->profile.counters.draws);
  EXPECT_GT(frame->counters.primitives, 2u);
}

TEST(Stage, FaultsOfAChainAreSaid) {
  const auto stage = open("builtin:cornell");
  ASSERT_TRUE(stage);
  const auto unknown = stage->add({.chain = {{{"Cul"}}}, .size = kSize});
  ASSERT_FALSE(unknown);
  EXPECT_THAT(unknown.error().message, HasSubstr("Cul"));
  EXPECT_FALSE(stage->add({.chain = {{{"Cull", {"colour=red"}}}}, .size = kSize}));
}

// And stay in their parameters' ranges, however odd the scene.
TEST(Stage, LengthsFollowTheSight) {
  const auto stage = open("builtin:cornell");
  ASSERT_TRUE(stage);
  const Length radius{"radius", 0.1f};
  const auto occluded =
      stage->add({.chain = {{{"Cull"}, {"GBuffer"}, {"ScreenSpaceAo", {}, {radius}}},
                            "ScreenSpaceAo.ambientVisibility"},
                  .size = kSize});
  ASSERT_TRUE(occluded);
  const CameraPose pose = seededCameras(stage->scene(), {.count = 1})[0].pose;
  Image small, large;
  ASSERT_TRUE(stage->look(pose, 0.1f));
  EXPECT_NEAR(stage->length("ScreenSpaceAo", radius), 0.01, 1e-6);
  ASSERT_TRUE(stage->draw(*occluded, &small));
  ASSERT_TRUE(stage->look(pose, 5.f));
  ASSERT_TRUE(stage->draw(*occluded, &large));
  EXPECT_FALSE(std::ranges::equal(small.bytes(), large.bytes()));
  for (const auto& [sight, metres] : {std::pair{1e-6f, 1e-3}, {1e9f, 1e4}}) {
    EXPECT_TRUE(stage->look(pose, sight));
    EXPECT_EQ(stage->length("ScreenSpaceAo", radius), metres);
  }
}

// What makes errors of a technique out of differences from the reference: nothing else differs.
TEST(Stage, PlainScenesAgreeWithTheReference) {
  for (const char* scene : {"builtin:cornell", "builtin:mirrors"}) {
    const auto stage = open(scene, Surfaces::Plain);
    ASSERT_TRUE(stage);
    Chain chain = kDeferred;
    chain.rows.back().settings = {"operator=linear"};
    const auto variant = stage->add({.chain = chain, .size = kSize});
    ASSERT_TRUE(variant);
    lookFromSomewhere(*stage, 1);
    Image picture;
    ASSERT_TRUE(stage->draw(*variant, &picture));
    const auto traced = trace::renderReference(stage->scene(), {.size = kSize,
                                                                .view = stage->view(kSize),
                                                                .samples = 1,
                                                                .primary = trace::Primary::Centre,
                                                                .shadows = false});
    Image truth = traced.color;
    for (float& value : truth.as<float>()) value = srgbFromLinear(value);
    EXPECT_GT(pixelMetrics(truth, converted(picture, ComponentType::F32, 3)).psnr, 45) << scene;
  }
}

TEST(Stage, VariantsOfAChainShareItAndKeepTheirSettings) {
  const auto stage = open("builtin:cornell");
  ASSERT_TRUE(stage);
  const auto variant = [&](double exposure) {
    return stage->add(
        {.chain = kDeferred, .size = kSize, .settings = {{"ToneMap", "exposure", exposure}}});
  };
  const auto bright = variant(0.0);
  const auto before = stage->device().objectCounts();
  const auto dark = variant(-8.0);
  ASSERT_TRUE(bright && dark);
  EXPECT_EQ(stage->device().objectCounts(), before);
  lookFromSomewhere(*stage);
  Image first, other, again;
  ASSERT_TRUE(stage->draw(*bright, &first));
  ASSERT_TRUE(stage->draw(*dark, &other));
  ASSERT_TRUE(stage->draw(*bright, &again));
  EXPECT_FALSE(std::ranges::equal(first.bytes(), other.bytes()));
  EXPECT_TRUE(std::ranges::equal(first.bytes(), again.bytes()));
  stage->clear();
  EXPECT_LT(stage->device().objectCounts().textures, before.textures);
}

TEST(Stage, OwnLightsStayAndCanBeChanged) {
  const auto stage = open("builtin:penumbra?case=overlap&k=3", Surfaces::Own, Lighting::Own);
  ASSERT_TRUE(stage);
  const std::vector<scene::Light> lights = stage->scene().lights;
  ASSERT_EQ(lights.size(), 3u);
  const auto variant = stage->add({.chain = kDeferred, .size = kSize});
  ASSERT_TRUE(variant);
  lookFromSomewhere(*stage);
  Image before, changed, after;
  ASSERT_TRUE(stage->draw(*variant, &before));
  stage->relight([](scene::Scene& scene) { scene.lights[1].color = vec3(0); });
  ASSERT_TRUE(stage->draw(*variant, &changed));
  stage->relight([&](scene::Scene& scene) { scene.lights = lights; });
  ASSERT_TRUE(stage->draw(*variant, &after));
  EXPECT_FALSE(std::ranges::equal(before.bytes(), changed.bytes()));
  EXPECT_TRUE(std::ranges::equal(before.bytes(), after.bytes()));
}

TEST(Stage, TranslucentSurfacesStayWhereTheyAreWanted) {
  const auto translucent = [](Surfaces surfaces) {
    const auto stage = open("builtin:penumbra?case=panes", surfaces);
    return std::ranges::count_if(stage->scene().objects, [&](const scene::Object& object) {
      return stage->scene().materials[object.material].alphaMode == scene::AlphaMode::Blend;
    });
  };
  EXPECT_EQ(translucent(Surfaces::Plain), 0);
  EXPECT_EQ(translucent(Surfaces::PlainAndTranslucent), translucent(Surfaces::Own));
  EXPECT_GT(translucent(Surfaces::Own), 0);
}

TEST(Stage, ASampleTellsOfShadows) {
  const auto stage = open("builtin:penumbra?case=overlap&k=3", Surfaces::Own, Lighting::Own);
  ASSERT_TRUE(stage);
  const auto variant = stage->add({.chain = {{{"Cull"},
                                              {"GBuffer"},
                                              {"ShadowMaps", {"localSize=64"}},
                                              {"TileLights"},
                                              {"ShadowLayers", {"layers=2"}},
                                              {"ShadowMask"},
                                              {"Penumbra"},
                                              {"ShadowBlur"},
                                              {"TiledLighting", {"shadows=layered"}}}},
                                   .size = kSize});
  const auto plain = stage->add({.chain = kDeferred, .size = kSize});
  ASSERT_TRUE(variant && plain) << (variant ? "" : variant.error().message);
  ASSERT_TRUE(stage->look(ownCameras(stage->scene(), 1)[0].pose));
  const auto shadowed = stage->draw(*variant), lit = stage->draw(*plain);
  ASSERT_TRUE(shadowed && lit);
  EXPECT_GT(shadowed->shadowTexels, 0u);
  EXPECT_LE(shadowed->shadowTexels, 3u * 6 * 64 * 64) << "wide lamps have several maps";
  EXPECT_EQ(shadowed->shadowLayers, 2);
  EXPECT_EQ(shadowed->lightsBeyond, 1);
  EXPECT_EQ(lit->shadowTexels, 0u);
  EXPECT_EQ(lit->shadowLayers, 0);
  EXPECT_GT(shadowed->textureBytes, lit->textureBytes + 4 * shadowed->shadowTexels)
      << "maps and the mask";
}

TEST(Stage, ShowsTheMomentThatIsAskedForWhereThingsMove) {
  for (const bool moving : {false, true}) {
    StageSettings settings{.render = {}, .lighting = Lighting::Own, .moving = moving};
    settings.render.scene = "builtin:atrium?moving=0.3";
    auto stage = Stage::open(settings);
    ASSERT_TRUE(stage) << stage.error().message;
    const auto number = (*stage)->add({.chain = kDeferred, .size = kSize});
    ASSERT_TRUE(number);
    ASSERT_TRUE((*stage)->look(ownCameras((*stage)->scene(), 1)[0].pose));
    const auto shown = [&](double seconds) {
      Image picture;
      (*stage)->at(seconds);
      EXPECT_TRUE((*stage)->draw(*number, &picture));
      return picture;
    };
    const Image start = shown(0), later = shown(2), again = shown(0);
    EXPECT_EQ(std::ranges::equal(start.bytes(), later.bytes()), !moving);
    EXPECT_TRUE(std::ranges::equal(start.bytes(), again.bytes()));
  }
}

}  // namespace
}  // namespace lucerna::app::bench
