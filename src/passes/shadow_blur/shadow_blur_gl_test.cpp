// Soft shadows in layers, beside percentage-closer ones, against what is known of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/testing.hpp"

namespace lucerna {
namespace {

constexpr float kWall = 6.f;  // m before the camera

void addLamp(scene::Scene& scene, vec3 eye, vec3 target) {
  scene::Light light;
  light.kind = scene::LightKind::Spot;
  light.intensity = 100.f;
  light.outerCone = 1.f;
  light.innerCone = 0.9f;
  testing::addLight(scene, light, eye, target);
}

void set(graph::Pipeline& pipeline, const std::string& type, const std::string& param,
         const graph::Value& value) {
  for (graph::PassRow& row : pipeline.passes)
    if (row.type == type) row.params[param] = value;
}

// shadows: of TiledLighting, with what it needs; layered ones also of "exponential" values and by
// penumbrae that are "sampled".
graph::Pipeline softRows(const std::string& shadows) {
  std::vector<std::string> types{"Cull", "GBuffer", "ShadowMaps", "TileLights", "TiledLighting"};
  const bool sampled = shadows == "sampled";
  const bool layered = shadows == "layered" || shadows == "exponential" || sampled;
  if (shadows == "none") std::erase(types, "ShadowMaps");
  if (layered)
    types.insert(types.end() - 1, {"ShadowLayers", "ShadowMask",
                                   sampled ? "NearestBlockers" : "Penumbra", "ShadowBlur"});
  if (shadows == "prefiltered") types.insert(types.end() - 1, "PrefilteredShadows");
  graph::Pipeline pipeline = testing::rows(types);
  pipeline.passes.back().params = {{"shadows", layered ? std::string("layered") : shadows},
                                   {"kernel", std::int64_t{23}},
                                   {"search", std::int64_t{11}}};
  set(pipeline, "ShadowLayers", "layers", std::int64_t{32});
  set(pipeline, "Penumbra", "search", std::int64_t{11});
  set(pipeline, "ShadowBlur", "kernel", std::int64_t{23});
  if (shadows == "exponential") set(pipeline, "ShadowMask", "values", shadows);
  if (sampled) set(pipeline, "ShadowBlur", "penumbrae", shadows);
  return pipeline;
}

// A spot lamp, a disc, beside the camera throws the shadow of a half-plane onto a wall.
// The half-plane's edge is half way between the lamp's plane and the wall, at x = 0.
constexpr float kLampX = -1.f;
scene::Scene halfPlane(float radius) {
  scene::Scene scene = testing::emptyScene();
  testing::addWall(scene, kWall);
  testing::addBox(scene, {-20.f, 0, -0.5f * kWall}, {40, 40, 1e-3f});
  addLamp(scene, {kLampX, 0.5f, 0}, {kLampX, 0.5f, -kWall});
  scene.lights.back().radius = radius;
  updateTransforms(scene);
  return scene;
}

// Share of the light that arrives along the middle row.
std::vector<double> middleRow(const scene::Scene& scene, const graph::Pipeline& pipeline,
                              uvec2 size) {
  const auto picture = [&](const graph::Pipeline& rows) {
    return testing::asFloatRgb(testing::valueOf(scene, rows, size, "TiledLighting.color"));
  };
  const Image soft = picture(pipeline), lit = picture(softRows("none"));
  std::vector<double> shares;
  for (int x = 0; x < soft.width(); ++x)
    shares.push_back(soft.pixel<float>(x, soft.height() / 2)[1] /
                     lit.pixel<float>(x, soft.height() / 2)[1]);
  return shares;
}

// Of a wall before the camera, m.
float metresAcross(const scene::Scene& scene, uvec2 size) {
  return 2.f * kWall * std::tan(0.5f * scene.cameras[0].fovY) * static_cast<float>(size.x) /
         static_cast<float>(size.y);
}

class SoftShadows : public ::testing::TestWithParam<std::string> {
 protected:
  void TearDown() override { testing::expectNoDebugMessages(); }
};
INSTANTIATE_TEST_SUITE_P(By, SoftShadows,
                         ::testing::Values("pcss", "prefiltered", "layered", "exponential",
                                           "sampled"),
                         [](const auto& parameter) { return parameter.param; });

TEST_P(SoftShadows, ArePenumbraeOfTheRightWidth) {
  constexpr uvec2 kPicture{513, 129};
  for (const float radius : {0.2f, 0.4f, 0.8f}) {
    SCOPED_TRACE(radius);
    const scene::Scene scene = halfPlane(radius);
    graph::Pipeline pipeline = softRows(GetParam());
    set(pipeline, "ShadowMaps", "localSize", std::int64_t{2048});
    const std::vector<double> shares = middleRow(scene, pipeline, kPicture);
    const float width = metresAcross(scene, kPicture);
    const float middle = -kLampX;  // as far behind the edge as before it
    double worst = 0;
    int within = 0;
    for (int x = kPicture.x / 2 + 2; x < static_cast<int>(kPicture.x); ++x) {
      const float at = width * ((static_cast<float>(x) + 0.5f) / kPicture.x - 0.5f);
      const double share = testing::visibleShareOfDisc((at - middle) / radius);
      worst = std::max(worst, std::abs(shares[static_cast<std::size_t>(x)] - share));
      within += std::abs(at - middle) < radius;
    }
    EXPECT_GT(within, 3);
    EXPECT_LT(worst, 0.12);
  }
}

// The blur reaches into tiles that are all dark or all lit, where nothing is blurred: what it finds
// there is the mask. The shadow's edge is level, as the second axis runs upwards.
TEST(ShadowBlur, TakesTilesWithoutPenumbraeAsTheirMask) {
  constexpr uvec2 kPicture{64, 256};
  constexpr float kEdge = 2.f;  // m: the shadow's on the wall, as high as the lamp is deep
  scene::Scene scene = testing::emptyScene();
  testing::addWall(scene, kWall);
  testing::addBox(scene, {0, -20.f, -0.5f * kWall}, {40, 40, 1e-3f});
  addLamp(scene, {0, -kEdge, 0}, {0, -kEdge, -kWall});
  scene.lights.back().radius = 0.8f;
  updateTransforms(scene);
  graph::Pipeline pipeline = softRows("layered");
  const Image without =
      testing::asFloatRgb(testing::valueOf(scene, pipeline, kPicture, "TiledLighting.color"));
  graph::PassRow row{.name = "ShadowTiles", .type = "ShadowTiles", .reads = {}, .params = {}};
  row.params["reach"] = std::int64_t{0};
  pipeline.passes.insert(std::ranges::find(pipeline.passes, "Penumbra", &graph::PassRow::type),
                         row);
  const Image with =
      testing::asFloatRgb(testing::valueOf(scene, pipeline, kPicture, "TiledLighting.color"));
  const float height = 2.f * kWall * std::tan(0.5f * scene.cameras[0].fovY);  // m
  const float step = std::ranges::max(without.as<float>()) / 255.f;
  int different = 0;
  for (int y = 0; y < with.height(); ++y) {
    const float at = height * (0.5f - (static_cast<float>(y) + 0.5f) / kPicture.y);
    if (at < 0.1f) continue;  // the box
    const float more =
        with.pixel<float>(kPicture.x / 2, y)[1] - without.pixel<float>(kPicture.x / 2, y)[1];
    different += std::abs(more) > step;
    if (at > kEdge + 0.1f) {
      EXPECT_GT(more, -step) << at;
    }
    if (at < kEdge - 0.1f) {
      EXPECT_LT(more, step) << at;
    }
  }
  EXPECT_GT(different, 10) << "penumbrae are wider than a tile";
  testing::expectNoDebugMessages();
}

// However many lamps overlap, each has the shadow that it has alone: light adds up.
TEST_P(SoftShadows, OfLampsTogetherAreThoseOfEachAlone) {
  constexpr uvec2 kPicture{96, 64};
  constexpr int kLamps = 32;
  scene::Scene scene = testing::emptyScene();
  testing::addWall(scene, kWall);
  testing::addBox(scene, {0, 0, -4}, vec3(0.7f));
  for (int i = 0; i < kLamps; ++i) {
    const float turn = 2.f * kPi * static_cast<float>(i) / kLamps;
    addLamp(scene, {1.5f * std::cos(turn), std::sin(turn), -1.f}, {0, 0, -kWall});
    scene.lights.back().radius = 0.1f;
    scene.lights.back().intensity = 2.f;
  }
  updateTransforms(scene);
  testing::expectSumOfEachLightAlone(scene, [&] {
    return testing::asFloatRgb(
        testing::valueOf(scene, softRows(GetParam()), kPicture, "TiledLighting.color"));
  });
}

// Where blockers are far in front bytes are those of bits, and so are penumbrae.
TEST(ShadowBlur, OfExponentialValuesHasThePenumbraeOfBits) {
  constexpr uvec2 kPicture{257, 65};
  for (const std::string resolution : {"half", "full"})
    for (const float radius : {0.2f, 0.8f}) {
      SCOPED_TRACE(fmt::format("{}, radius {}", resolution, radius));
      const scene::Scene scene = halfPlane(radius);
      std::vector<double> shares[2];
      for (const bool exponential : {false, true}) {
        graph::Pipeline pipeline = softRows(exponential ? "exponential" : "layered");
        set(pipeline, "ShadowBlur", "resolution", resolution);
        shares[exponential] = middleRow(scene, pipeline, kPicture);
      }
      double worst = 0;
      for (std::size_t x = 0; x < kPicture.x; ++x)
        worst = std::max(worst, std::abs(shares[0][x] - shares[1][x]));
      EXPECT_LT(worst, 0.01);
    }
  testing::expectNoDebugMessages();
}

// A blocker as far before the wall as leaves a third of the light: nothing but bytes tells.
TEST(ShadowBlur, KeepsWhatExponentialValuesLetThrough) {
  constexpr uvec2 kPicture{257, 65};
  const scene::Scene scene = halfPlane(0.4f);
  const double share = 1. / 3.;
  for (const std::string resolution : {"half", "full"}) {
    SCOPED_TRACE(resolution);
    graph::Pipeline pipeline = softRows("exponential");
    set(pipeline, "ShadowMask", "falloff", -std::log(share) / (0.5 * kWall));
    set(pipeline, "ShadowBlur", "resolution", resolution);
    const std::vector<double> shares = middleRow(scene, pipeline, kPicture);
    const double pixels = kPicture.x / static_cast<double>(metresAcross(scene, kPicture));
    const auto at = [&](double metres) {
      return shares[static_cast<std::size_t>(0.5 * kPicture.x + metres * pixels)];
    };
    const double middle = -static_cast<double>(kLampX);
    EXPECT_NEAR(at(middle - 0.35), share, 0.05);
    EXPECT_NEAR(at(middle), 0.5 * (1 + share), 0.08);
    EXPECT_NEAR(at(middle + 0.5), 1., 0.01);
  }
  testing::expectNoDebugMessages();
}

// Lamps of all sizes above two boxes before a wall.
scene::Scene lampsOfAllSizes() {
  constexpr int kLamps = 9;
  scene::Scene scene = testing::emptyScene();
  testing::addWall(scene, kWall);
  testing::addBox(scene, {0, 0, -4}, vec3(0.7f));
  testing::addBox(scene, {0.6f, 0.4f, -5}, vec3(0.3f));
  constexpr int kMiddle = kLamps / 2;
  for (int i = 0; i < kLamps; ++i) {
    addLamp(scene, {0.4f * static_cast<float>(i - kMiddle), 0.8f, -1.f}, {0, 0, -kWall});
    scene.lights.back().radius = 0.05f * static_cast<float>(i + 1);
    scene.lights.back().intensity = 5.f;
  }
  updateTransforms(scene);
  return scene;
}

// Of the brightest.
float largestDifference(const Image& a, const Image& b) {
  float largest = 0, brightest = 0;
  for (std::size_t i = 0; i < a.as<float>().size(); ++i) {
    largest = std::max(largest, std::abs(a.as<float>()[i] - b.as<float>()[i]));
    brightest = std::max(brightest, a.as<float>()[i]);
  }
  return largest / brightest;
}

// Values that differ by more than a step of a byte of the brightest.
std::size_t unlike(const Image& a, const Image& b) {
  const float step = std::ranges::max(a.as<float>()) / 255.f;
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.as<float>().size(); ++i)
    count += std::abs(a.as<float>()[i] - b.as<float>()[i]) > step;
  return count;
}

// Each layer has its own byte. At edges bits are the mean of four depths, values are of the
// nearest.
TEST(ShadowBlur, OfExponentialValuesOfManyLampsIsThatOfBits) {
  const scene::Scene scene = lampsOfAllSizes();
  for (const std::string resolution : {"half", "full"}) {
    SCOPED_TRACE(resolution);
    Image pictures[2];
    for (const bool exponential : {false, true}) {
      graph::Pipeline pipeline = softRows(exponential ? "exponential" : "layered");
      set(pipeline, "ShadowBlur", "resolution", resolution);
      pictures[exponential] =
          testing::asFloatRgb(testing::valueOf(scene, pipeline, {161, 97}, "TiledLighting.color"));
    }
    EXPECT_LT(unlike(pictures[0], pictures[1]), pictures[0].as<float>().size() / 300);
  }
  testing::expectNoDebugMessages();
}

// What is sampled is what Penumbra stores, but for the rounding of half floats, which may move a
// tap.
TEST(ShadowBlur, OfSampledPenumbraeIsThatOfStoredOnes) {
  const scene::Scene scene = lampsOfAllSizes();
  const auto picture = [&](const graph::Pipeline& pipeline) {
    return testing::asFloatRgb(testing::valueOf(scene, pipeline, {161, 97}, "TiledLighting.color"));
  };
  const Image hard = picture(softRows("hard"));
  for (const bool tiles : {false, true})
    for (const std::string resolution : {"half", "full"})
      for (const std::string variant : {"mended", "published"}) {
        SCOPED_TRACE(fmt::format("tiles {}, {}, {}", tiles, resolution, variant));
        graph::Pipeline pipeline = softRows("sampled");
        const auto blur = std::ranges::find(pipeline.passes, "ShadowBlur", &graph::PassRow::type);
        blur->params["resolution"] = resolution, blur->params["variant"] = variant;
        if (tiles) pipeline.passes.insert(blur, testing::rows({"ShadowTiles"}).passes[0]);
        const Image sampled = picture(pipeline);
        graph::PassRow penumbra = testing::rows({"Penumbra"}).passes[0];
        penumbra.params = {
            {"method", std::string("minimum")}, {"resolution", resolution}, {"variant", variant}};
        pipeline.passes.insert(
            std::ranges::find(pipeline.passes, "ShadowBlur", &graph::PassRow::type), penumbra);
        set(pipeline, "ShadowBlur", "penumbrae", std::string("stored"));
        EXPECT_LT(largestDifference(picture(pipeline), sampled), 1.f / 255.f);
        EXPECT_GT(largestDifference(hard, sampled), 0.03f);
      }
  testing::expectNoDebugMessages();
}

// As published, circles shrink with the surface's slope, here to half: a shadow's edge that runs
// along the view over a floor is half as soft as an ellipse makes it.
TEST(ShadowBlur, AsPublishedIsACircleThatShrinksOnGrazedSurfaces) {
  constexpr uvec2 kPicture{512, 128};
  scene::Scene scene = testing::emptyScene();
  testing::addWall(scene, 30.f);
  testing::addBox(scene, {0, -1.05f, -10}, {40, 0.1f, 40});  // the floor, a metre below the eye
  testing::addBox(scene, {-20, 1, -10}, {40, 1e-3f, 40});
  addLamp(scene, {0, 5, -6}, {0, -1, -6.1f});
  scene.lights.back().radius = 1.2f;
  updateTransforms(scene);
  double widths[2];
  for (const bool published : {false, true}) {
    graph::Pipeline pipeline = softRows("layered");
    set(pipeline, "ShadowBlur", "resolution", std::string("full"));
    set(pipeline, "ShadowBlur", "variant", std::string(published ? "published" : "mended"));
    const auto picture = [&](const graph::Pipeline& rows) {
      return testing::asFloatRgb(testing::valueOf(scene, rows, kPicture, "TiledLighting.color"));
    };
    const Image soft = picture(pipeline), lit = picture(softRows("none"));
    const int y = 86;  // px, some 6 m away
    int within = 0;
    for (int x = soft.width() / 2 - 80; x < soft.width() / 2 + 80; ++x) {
      const float share = soft.pixel<float>(x, y)[1] / lit.pixel<float>(x, y)[1];
      within += share > 0.1f && share < 0.9f;
    }
    widths[published] = within;
  }
  EXPECT_GT(widths[0], 16);
  EXPECT_NEAR(widths[1] / widths[0], 0.5, 0.1);
  testing::expectNoDebugMessages();
}

// As published, depths are compared as they are stored: far from the eye those of two surfaces are
// the same, and light of the half-plane gets into the shadow beside it.
TEST(ShadowBlur, AsPublishedTellsNoSurfacesApartFarAway) {
  constexpr uvec2 kPicture{257, 65};
  const scene::Scene scene = halfPlane(0.4f);
  double lightest[2];
  for (const bool published : {false, true}) {
    graph::Pipeline pipeline = softRows("layered");
    set(pipeline, "ShadowBlur", "resolution", std::string("full"));
    set(pipeline, "ShadowBlur", "variant", std::string(published ? "published" : "mended"));
    const std::vector<double> shares = middleRow(scene, pipeline, kPicture);
    // Right of the half-plane's edge the wall is dark up to 0.6 m.
    const std::size_t edge = kPicture.x / 2 + 2;
    lightest[published] = *std::max_element(shares.begin() + edge, shares.begin() + edge + 3);
  }
  EXPECT_LT(lightest[0], 0.01);
  EXPECT_GT(lightest[1], 0.1);
  testing::expectNoDebugMessages();
}

// Two spots side by side on a wall, each with a cube in its light: one layer is enough for both
// while what they reach is far enough apart, and each has the shadow that it has alone.
TEST(LayersOfTiles, AreSharedByLampsThatAreApart) {
  constexpr uvec2 kPicture{384, 96};
  for (const float side : {5.f, 0.6f}) {
    SCOPED_TRACE(side);
    scene::Scene scene = testing::emptyScene();
    testing::addWall(scene, kWall);
    for (const float x : {-side, side}) {
      testing::addBox(scene, {x, 0, -5}, vec3(0.3f));
      addLamp(scene, {x, 0.2f, -3}, {x, 0, -kWall});
      scene.lights.back().outerCone = 0.3f;
      scene.lights.back().innerCone = 0.25f;
      scene.lights.back().radius = 0.15f;
    }
    updateTransforms(scene);
    const auto picture = [&](std::int64_t layers) {
      graph::Pipeline pipeline = softRows("layered");
      for (graph::PassRow& row : pipeline.passes)
        if (row.type == "ShadowLayers") row.params["layers"] = layers;
      return testing::asFloatRgb(
          testing::valueOf(scene, pipeline, kPicture, "TiledLighting.color"));
    };
    // One layer is as good as many, or the second lamp goes without and has a hard shadow.
    const Image one = picture(1), many = picture(32);
    EXPECT_EQ(std::ranges::equal(one.bytes(), many.bytes()), side > 1.f);
    Image sum = many;
    std::ranges::fill(sum.as<float>(), 0.f);
    for (const bool first : {true, false}) {
      scene.lights[0].on = first, scene.lights[1].on = !first;
      const Image alone = picture(1);
      for (std::size_t i = 0; i < sum.as<float>().size(); ++i)
        sum.as<float>()[i] += alone.as<float>()[i];
    }
    for (std::size_t i = 0; i < sum.as<float>().size(); ++i)
      ASSERT_NEAR(sum.as<float>()[i], many.as<float>()[i], 2e-2f * many.as<float>()[i] + 1e-3f);
  }
  testing::expectNoDebugMessages();
}

}  // namespace
}  // namespace lucerna
