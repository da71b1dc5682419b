#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "support/testing.hpp"

namespace lucerna {
namespace {

constexpr uvec2 kSize{160, 90};

graph::Pipeline rows(const graph::ParamValues& params) {
  graph::Pipeline pipeline =
      testing::rows({"Cull", "Forward", "Background", "DepthOfField", "ToneMap"});
  pipeline.passes[3].params = params;
  return pipeline;
}

Image sharp(const scene::Scene& scene) {
  return testing::asFloatRgb(testing::valueOf(scene, rows({}), kSize, "Background.color"));
}

Image blurred(const scene::Scene& scene, const graph::ParamValues& params) {
  return testing::asFloatRgb(testing::valueOf(scene, rows(params), kSize, "DepthOfField.color"));
}

bool equal(const Image& a, const Image& b) {
  return std::ranges::equal(a.bytes(), b.bytes());
}

// A luminous card that faces the camera of emptyScene(), from corner to corner in m.
void addCard(scene::Scene& scene, float distance, vec2 from, vec2 to, vec3 color) {
  scene::Material& material = testing::addWall(scene, distance);
  material.albedo = {0, 0, 0, 1};
  material.emissive = color;
  scene::Node& node = scene.nodes[scene.objects.back().node];
  node.translation = vec3(0.5f * (from + to), node.translation.z);
  node.scale = vec3(to - from, node.scale.z);
  updateTransforms(scene);
}

void addHalf(scene::Scene& scene, float distance, bool right, vec3 color) {
  addCard(scene, distance, {right ? 0 : -50, -50}, {right ? 50 : 0, 50}, color);
}

// White at x > 0, black at x < 0, both at one distance.
scene::Scene edge(float distance, bool orthographic = false) {
  scene::Scene scene = testing::emptyScene();
  scene.cameras[0].orthographic = orthographic;
  addHalf(scene, distance, true, vec3(1));
  addHalf(scene, distance, false, vec3(0));
  return scene;
}

// px: the circle of confusion by the lens's own geometry. Its rim and the point span a cone, which
// cuts the plane in focus in a circle.
float circleRadius(const scene::Camera& camera, float lensRadius, float focus, float distance) {
  const float away = std::isinf(distance) ? 1.f : std::abs(distance - focus) / distance;
  const float onFocus = camera.orthographic ? std::abs(distance - focus) / focus : away;
  const float height =
      camera.orthographic ? camera.height : 2.f * focus * std::tan(0.5f * camera.fovY);
  return lensRadius * onFocus / height * static_cast<float>(kSize.y);
}

// px: of a disc that blurs an edge as a row does. The rise has the disc's variance along
// x, a quarter of its squared radius.
float radiusOfEdge(const Image& image, int y) {
  double sum = 0, first = 0, second = 0;
  for (int x = 1; x < image.width(); ++x) {
    const double rise = image.pixel<float>(x, y)[1] - image.pixel<float>(x - 1, y)[1];
    sum += rise, first += rise * x, second += rise * x * x;
  }
  return static_cast<float>(2. * std::sqrt(second / sum - first / sum * (first / sum)));
}
float radiusOfEdge(const Image& image) {
  return radiusOfEdge(image, image.height() / 2);
}

// 10 %; a third of a pixel where that is less.
void expectRadius(const Image& image, float radius) {
  EXPECT_NEAR(radiusOfEdge(image), radius, std::max(0.1f * radius, 0.35f));
}

double sumOf(const Image& image) {
  double sum = 0;
  for (const float value : image.as<float>()) sum += value;
  return sum;
}

class DepthOfField : public ::testing::TestWithParam<std::string> {
 protected:
  void TearDown() override { testing::expectNoDebugMessages(); }

  static graph::ParamValues lens(double radius, double focus) {
    return {{"method", GetParam()}, {"lensRadius", radius}, {"focusDistance", focus}};
  }
  static bool gathers() { return GetParam() == "gather"; }
};
INSTANTIATE_TEST_SUITE_P(By, DepthOfField, ::testing::Values("gather", "separable"),
                         [](const auto& parameter) { return parameter.param; });

TEST_P(DepthOfField, AllInFocusIsUnchangedBitForBit) {
  const scene::Scene sample = testing::sampleScene();
  for (const double radius : {0., 1e-5})
    EXPECT_TRUE(equal(blurred(sample, lens(radius, 3)), sharp(sample)));
  EXPECT_FALSE(equal(blurred(sample, lens(0.1, 3)), sharp(sample)));

  const scene::Scene wall = edge(4.f);
  EXPECT_TRUE(equal(blurred(wall, lens(0.5, 4)), sharp(wall)));
  EXPECT_FALSE(equal(blurred(wall, lens(0.5, 3)), sharp(wall)));
}

TEST_P(DepthOfField, AnEdgeIsAsWideAsThroughAThinLens) {
  for (const bool orthographic : {false, true})
    for (const float distance : {1.5f, 2.5f, 4.f, 8.f}) {
      SCOPED_TRACE(::testing::Message()
                   << (orthographic ? "orthographic, " : "perspective, ") << distance << " m");
      const scene::Scene scene = edge(distance, orthographic);
      expectRadius(blurred(scene, lens(0.15, 3)),
                   circleRadius(scene.cameras[0], 0.15f, 3.f, distance));
    }
}

TEST_P(DepthOfField, AnEyeBesideTheMiddleSeesTheSameCircles) {
  const scene::Scene scene = edge(1.5f);
  const scene::View middle = viewOf(scene, scene.cameras[0], 16.f / 9.f);
  testing::SceneRenderer renderer(scene);
  const auto output = renderer.render(rows(lens(0.15, 3)), eyeView(middle, 0.2f, 3.f), kSize,
                                      {"DepthOfField.color"});
  ASSERT_TRUE(output);
  expectRadius(testing::asFloatRgb(output->kept.at("DepthOfField.color")),
               circleRadius(scene.cameras[0], 0.15f, 3.f, 1.5f));
}

TEST_P(DepthOfField, TheBackgroundIsInfinitelyFar) {
  scene::Scene scene = testing::emptyScene();
  Image halves(256, 2, 4, ComponentType::U8);
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 256; ++x)
      std::fill_n(halves.pixel<std::uint8_t>(x, y), 4, std::uint8_t(x < 128 ? 0 : 255));
  scene.textures.emplace_back().image = std::make_shared<const Image>(std::move(halves));
  scene.background.kind = scene::BackgroundKind::Image;
  scene.background.texture = 0;
  const float infinity = std::numeric_limits<float>::infinity();
  expectRadius(blurred(scene, lens(0.15, 3)), circleRadius(scene.cameras[0], 0.15f, 3.f, infinity));
}

// A red object in focus before a blurred wall of white and black.
TEST_P(DepthOfField, ASharpObjectStaysSharp) {
  scene::Scene scene = testing::emptyScene();
  for (int i = -10; i < 10; ++i)
    addCard(scene, 8.f, {i, -20}, {i + 1, 20}, vec3(i % 2 == 0 ? 1 : 0));
  addCard(scene, 2.f, {-0.4f, -0.3f}, {0.4f, 0.3f}, {1, 0, 0});
  const Image before = sharp(scene), after = blurred(scene, lens(0.2, 2));
  int red = 0, changed = 0, object = 0;
  for (int y = 0; y < before.height(); ++y)
    for (int x = 0; x < before.width(); ++x) {
      const float *was = before.pixel<float>(x, y), *is = after.pixel<float>(x, y);
      if (was[0] == 1 && was[1] == 0)
        ++object, changed += !std::equal(was, was + 3, is);
      else
        red += is[0] != is[1];
    }
  EXPECT_GT(object, 1000);
  EXPECT_EQ(changed, 0) << "pixels of the object";
  if (gathers())
    EXPECT_EQ(red, 0) << "pixels of the wall";
  else
    EXPECT_GT(red, 300) << "the separable method bleeds: has it got better?";
}

// Blurred things in front reach over what is sharp, on both sides of their edge alike, and do not
// end where their pixels end.
TEST(DepthOfFieldGather, ABlurredForegroundSpreadsOverASharpBackground) {
  scene::Scene scene = testing::emptyScene();
  addCard(scene, 3.f, {-50, -50}, {50, 50}, vec3(0));
  addHalf(scene, 1.5f, true, vec3(1));
  const Image image = blurred(scene, {{"lensRadius", 0.3}, {"focusDistance", 3.0}});
  expectRadius(image, circleRadius(scene.cameras[0], 0.3f, 3.f, 1.5f));
  const float *left = image.pixel<float>(79, 45), *right = image.pixel<float>(80, 45);
  EXPECT_NEAR(0.5f * (left[0] + right[0]), 0.5f, 0.03f);
  EXPECT_LT(right[0] - left[0], 0.1f);
}

// So do blurred things in front of blurred ones, before and behind the plane in focus.
TEST(DepthOfFieldGather, AnEdgeBetweenDistancesIsThatOfTheNearerThing) {
  for (const auto& [nearer, farther] : {std::pair{4.5f, 40.f}, {1.f, 2.5f}}) {
    SCOPED_TRACE(nearer);
    scene::Scene scene = testing::emptyScene();
    addHalf(scene, nearer, true, vec3(1));
    addCard(scene, farther, {-80, -80}, {80, 80}, vec3(0));
    expectRadius(blurred(scene, {{"lensRadius", 0.15}, {"focusDistance", 3.0}}),
                 circleRadius(scene.cameras[0], 0.15f, 3.f, nearer));
  }
}

// The nearer thing is one, although its circles are narrow above and wide below: a luminous half
// that leans towards the eye, before a bright wall in focus.
TEST(DepthOfFieldGather, AnEdgeGoesOnFromNarrowToWideCircles) {
  scene::Scene scene = testing::emptyScene();
  addCard(scene, 6.f, {-50, -50}, {50, 50}, vec3(0.5f));
  addHalf(scene, 3.f, true, vec3(1));
  scene::Node& node = scene.nodes[scene.objects.back().node];
  const float lean = 0.9f;  // rad
  node.rotation = glm::angleAxis(lean, vec3(1, 0, 0));
  updateTransforms(scene);
  const Image image = blurred(scene, {{"lensRadius", 0.5}, {"focusDistance", 6.0}});
  const float pixel = 2.f * std::tan(0.5f * scene.cameras[0].fovY) / static_cast<float>(kSize.y);
  float narrowest = 1e9f, widest = 0.f;
  for (int y = 15; y < 75; y += 5) {
    const float slope =
        pixel * (0.5f * static_cast<float>(kSize.y) - (static_cast<float>(y) + 0.5f));
    // On the plane through (0, 0, -3) along (0, cos, sin): slope * distance upwards.
    const float distance = 3.f / (1.f + slope * std::tan(lean));
    const float radius = circleRadius(scene.cameras[0], 0.5f, 6.f, distance);
    SCOPED_TRACE(::testing::Message() << "row " << y << ", " << radius << " px");
    EXPECT_NEAR(radiusOfEdge(image, y), radius, std::max(0.12f * radius, 0.5f));
    narrowest = std::min(narrowest, radius);
    widest = std::max(widest, radius);
  }
  EXPECT_LT(narrowest, 6.f);
  EXPECT_GT(widest, 12.f);
}

// A lamp of a few pixels, brighter than all else, becomes an even disc, although most of the disc
// is read in strides; and no light is lost.
TEST(DepthOfFieldGather, ALampBecomesAnEvenDisc) {
  for (const float distance : {1.8f, 9.f}) {
    SCOPED_TRACE(distance);
    scene::Scene scene = testing::emptyScene();
    const float size = 0.03f * distance;
    addCard(scene, distance, vec2(-size), vec2(size), vec3(1e4f));
    addCard(scene, distance + 0.1f, {-50, -50}, {50, 50}, vec3(0));
    const Image before = sharp(scene);
    const Image after = blurred(scene, {{"lensRadius", 1.0}, {"focusDistance", 3.0}});
    EXPECT_NEAR(sumOf(after) / sumOf(before), 1., 0.05);
    const float radius = circleRadius(scene.cameras[0], 1.f, 3.f, distance);
    ASSERT_GT(radius, 17.f) << "for a stride of four pixels";
    float least = 1e9f, most = 0.f;
    for (int y = 0; y < after.height(); ++y)
      for (int x = 0; x < after.width(); ++x)
        if (glm::length(vec2(x, y) + 0.5f - 0.5f * vec2(kSize)) < 0.5f * radius) {
          least = std::min(least, after.pixel<float>(x, y)[0]);
          most = std::max(most, after.pixel<float>(x, y)[0]);
        }
    EXPECT_LT(most, 1.15f * least);
  }
}

// So does a lamp with a narrow circle beside something with a wide one, which is read in strides:
// before the plane in focus, a card that is too far to the right to hide it; behind it, the sky.
TEST(DepthOfFieldGather, ANarrowCircleBesideAWideOneIsNoLessEven) {
  for (const auto& [distance, lens] : {std::pair{2.3f, 0.3f}, {3.6f, 0.5f}}) {
    SCOPED_TRACE(distance);
    scene::Scene scene = testing::emptyScene();
    const float size = 0.01f * distance;
    addCard(scene, distance, vec2(-size), vec2(size), vec3(1e3f));
    if (distance < 3.f) {
      addCard(scene, 3.f, {-50, -50}, {50, 50}, vec3(0));
      addCard(scene, 1.f, {0.25f, -5}, {5, 5}, vec3(0));
      ASSERT_GT(circleRadius(scene.cameras[0], lens, 3.f, 1.f), 9.f) << "wide";
    }
    const Image before = sharp(scene);
    const Image after = blurred(scene, {{"lensRadius", lens}, {"focusDistance", 3.0}});
    EXPECT_NEAR(sumOf(after) / sumOf(before), 1., 0.1);
    const float radius = circleRadius(scene.cameras[0], lens, 3.f, distance);
    ASSERT_LT(radius, 8.f) << "narrow";
    const float sky =
        circleRadius(scene.cameras[0], lens, 3.f, std::numeric_limits<float>::infinity());
    ASSERT_TRUE(distance < 3.f || sky > 9.f) << "wide";
    float least = 1e9f, most = 0.f;
    for (int y = 0; y < after.height(); ++y)
      for (int x = 0; x < after.width(); ++x) {
        const float away = glm::length(vec2(x, y) + 0.5f - 0.5f * vec2(kSize));
        const float value = after.pixel<float>(x, y)[0];
        if (away < 0.5f * radius) least = std::min(least, value);
        EXPECT_TRUE(away < radius + 4.f || value == 0.f || x > 90) << x << ", " << y;
        most = std::max(most, value);
      }
    EXPECT_LT(most, 1.3f * least);
  }
}

TEST_P(DepthOfField, StaysFiniteWhereItIsVeryBright) {
  scene::Scene scene = edge(8.f);
  for (scene::Material& material : scene.materials) material.emissive *= 1e4f;
  addCard(scene, 1.f, {0.1f, -0.2f}, {0.4f, 0.2f}, vec3(1e4f));
  const Image image = blurred(scene, lens(1, 3));
  EXPECT_TRUE(std::ranges::all_of(
      image.as<float>(), [](float v) { return std::isfinite(v) && v >= 0.f && v <= 1.01e4f; }));
}

TEST_P(DepthOfField, RowsCanBeDoubledAndSwitchedOff) {
  const scene::Scene scene = testing::sampleScene();
  graph::Pipeline pipeline = rows(lens(0.1, 3));
  pipeline.passes.insert(pipeline.passes.begin() + 4, pipeline.passes[3]);
  pipeline.passes[4].name = "Second";
  const auto colorOf = [&](const char* name) {
    return testing::asFloatRgb(testing::valueOf(scene, pipeline, kSize, name));
  };
  const Image once = blurred(scene, lens(0.1, 3));
  EXPECT_TRUE(equal(colorOf("DepthOfField.color"), once));
  EXPECT_FALSE(equal(colorOf("Second.color"), once));
  pipeline.passes[3].enabled = false;
  EXPECT_TRUE(equal(colorOf("Second.color"), once));
  pipeline.passes[4].enabled = false;
  const Image off = testing::pictureOf(scene, pipeline, kSize);
  EXPECT_TRUE(equal(off, testing::pictureOf(scene, rows(lens(0, 3)), kSize)));
}

TEST(DepthOfFieldSetup, ShowsFocusInRedAndBlurInWhite) {
  scene::Scene scene = testing::emptyScene();
  scene.exposure = 3.f;
  addHalf(scene, 3.f, true, vec3(1));
  addHalf(scene, 1.5f, false, vec3(1));
  const Image image = blurred(scene, {{"view", std::string("setup")},
                                      {"lensRadius", 0.2},
                                      {"focusDistance", 3.0},
                                      {"maximumRadius", 20.0}});
  const vec3 focus = testing::colorAt(image, 120, 45), blur = testing::colorAt(image, 40, 45);
  EXPECT_EQ(focus, vec3(0.125f, 0, 0)) << "as bright as red at the scene's exposure";
  const float amount = circleRadius(scene.cameras[0], 0.2f, 3.f, 1.5f) / 20.f;
  EXPECT_NEAR(blur.x / 0.125f, amount, 0.01f);
  EXPECT_EQ(blur, vec3(blur.x));
}

}  // namespace
}  // namespace lucerna
