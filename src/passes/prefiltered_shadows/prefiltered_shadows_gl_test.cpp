// Prefiltered shadows of known shape, for each kind of light and map. Widths of penumbrae:
// By/SoftShadows of shadow_blur_gl_test.cpp and tests/e2e/prefiltered_kernel_test.cpp.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "support/testing.hpp"

namespace lucerna {
namespace {

constexpr uvec2 kSize{65, 65};  // odd: the middle pixel looks along the axis
constexpr float kWall = 6.f;    // m before the camera

struct Case {
  std::string name;
  scene::LightKind kind;
  std::string method;    // of ShadowMaps
  std::string penumbra;  // of PrefilteredShadows
};

std::vector<Case> cases() {
  using enum scene::LightKind;
  std::vector<Case> made;
  for (const std::string penumbra : {"kernel", "light"})
    for (const auto& [name, kind, method] :
         {std::tuple{"Lispsm", Directional, "lispsm"},
          std::tuple{"Uniform", Directional, "uniform"},
          std::tuple{"Cascades", Directional, "cascades"}, std::tuple{"Spot", Spot, "lispsm"},
          std::tuple{"Point", Point, "lispsm"}})
      made.push_back({fmt::format("{}By{}", name, penumbra == "kernel" ? "Kernel" : "Light"), kind,
                      method, penumbra});
  return made;
}

graph::Pipeline pipelineOf(const Case& c) {
  graph::Pipeline pipeline = testing::rows(
      {"Cull", "GBuffer", "CustomShaders", "ShadowMaps", "PrefilteredShadows", "TiledLighting"});
  for (graph::PassRow& row : pipeline.passes) {
    if (row.type == "ShadowMaps") row.params = {{"method", c.method}, {"size", std::int64_t{1024}}};
    if (row.type == "PrefilteredShadows") row.params["penumbra"] = c.penumbra;
    if (row.type == "TiledLighting") row.params["shadows"] = std::string("prefiltered");
  }
  return pipeline;
}

const graph::Pipeline& unshadowed() {
  static const graph::Pipeline pipeline = testing::rows({"Cull", "GBuffer", "TiledLighting"});
  return pipeline;
}

Image pictureOf(const scene::Scene& scene, const graph::Pipeline& pipeline) {
  return testing::asFloatRgb(testing::valueOf(scene, pipeline, kSize, "TiledLighting.color"));
}

// Small enough for penumbrae narrower than what the tests look at.
void addLamp(scene::Scene& scene, scene::LightKind kind, vec3 eye, vec3 target) {
  scene::Light light;
  light.kind = kind;
  light.intensity = kind == scene::LightKind::Directional ? kPi : 100.f;
  light.radius = 0.05f;
  light.outerCone = 1.f;
  light.innerCone = 0.9f;
  testing::addLight(scene, light, eye, target);
  updateTransforms(scene);
}

// The share of its light that reaches the point of the wall that the camera sees there.
float shareAt(const scene::Scene& scene, const Image& shadowed, const Image& lit, vec3 pointW) {
  const vec4 clip = viewOf(scene, scene.cameras[0], 1.f).clipFromWorld() * vec4(pointW, 1.f);
  const ivec2 pixel((vec2(clip) / clip.w * vec2(0.5f, -0.5f) + 0.5f) * vec2(kSize));
  return shadowed.pixel<float>(pixel.x, pixel.y)[1] / lit.pixel<float>(pixel.x, pixel.y)[1];
}

class PrefilteredShadows : public ::testing::TestWithParam<Case> {
 protected:
  void TearDown() override { testing::expectNoDebugMessages(); }
};
INSTANTIATE_TEST_SUITE_P(Of, PrefilteredShadows, ::testing::ValuesIn(cases()),
                         [](const auto& parameter) { return parameter.param.name; });

// Wide kernels take a plane that the light grazes for something bent: its end is in them, too.
TEST_P(PrefilteredShadows, APlaneDoesNotShadowItself) {
  for (const float degrees : {0.f, 20.f, 70.f, 85.f, 89.f})
    for (const std::int64_t kernel : {1, 5, 23}) {
      if (kernel > 5 && degrees > 70.f) continue;
      scene::Scene scene = testing::emptyScene();
      testing::addWall(scene, kWall);
      const float angle = degrees * kPi / 180.f;
      const vec3 target(0, 0, -kWall);
      const vec3 toLight(0.8f * std::sin(angle), 0.6f * std::sin(angle), std::cos(angle));
      addLamp(scene, GetParam().kind, target + 4.f * toLight, target);
      graph::Pipeline pipeline = pipelineOf(GetParam());
      pipeline.passes[4].params["kernel"] = kernel;
      const Image plain = pictureOf(scene, unshadowed()), found = pictureOf(scene, pipeline);
      float worst = 0.f;
      for (std::size_t i = 0; i < plain.as<float>().size(); ++i)
        if (plain.as<float>()[i] > 0.f)
          worst = std::max(worst, std::abs(1.f - found.as<float>()[i] / plain.as<float>()[i]));
      EXPECT_LE(worst, 1.f / 255.f) << "light at " << degrees << " degrees, kernel " << kernel;
    }
}

// The shadow lies where straight lines from the light put it: dark in its middle, lit beside it.
TEST_P(PrefilteredShadows, ACubeThrowsItsShadowWhereItBelongs) {
  scene::Scene scene = testing::emptyScene();
  testing::addWall(scene, kWall);
  testing::addBox(scene, {0, 0, -4}, vec3(0.6f));
  const vec3 eye(3, 1.5f, -1);  // and past the cube to the wall
  addLamp(scene, GetParam().kind, eye, {0, 0, -4});
  const Image found = pictureOf(scene, pipelineOf(GetParam()));
  const Image lit = pictureOf(scene, unshadowed());
  const vec3 along = vec3(0, 0, -4) - eye;
  const vec3 middle = vec3(0, 0, -4) + along * ((kWall - 4.f) / -along.z);
  EXPECT_LT(shareAt(scene, found, lit, middle), 0.01f);
  for (const vec3 offset : {vec3(1.2f, 0, 0), vec3(-1.2f, 0, 0), vec3(0, 1, 0), vec3(0, -1, 0)})
    EXPECT_GT(shareAt(scene, found, lit, middle + offset), 0.99f);
}

TEST_P(PrefilteredShadows, AreTheSameBitsEachTime) {
  scene::Scene scene = testing::emptyScene();
  testing::addWall(scene, kWall);
  testing::addBox(scene, {0, 0, -4}, vec3(0.6f));
  addLamp(scene, GetParam().kind, {3, 1.5f, -1}, {0, 0, -4});
  graph::Pipeline pipeline = pipelineOf(GetParam());
  const Image first = pictureOf(scene, pipeline);
  pipeline.passes[4].params["redraw"] = std::string("always");
  testing::SceneRenderer renderer(scene);
  for (int frame = 0; frame < 3; ++frame) {
    auto output = renderer.render(pipeline, kSize, {"TiledLighting.color"});
    ASSERT_TRUE(output) << output.error().message;
    const Image again = testing::asFloatRgb(output->kept.at("TiledLighting.color"));
    EXPECT_TRUE(std::ranges::equal(first.bytes(), again.bytes())) << frame;
  }
}

TEST_P(PrefilteredShadows, AreMadeAnewWhereAMapHasChanged) {
  scene::Scene scene = testing::emptyScene();
  testing::addWall(scene, kWall);
  testing::addBox(scene, {0, 0, -4}, vec3(0.6f));
  addLamp(scene, GetParam().kind, {3, 1.5f, -1}, {0, 0, -4});
  testing::SceneRenderer renderer(scene);
  renderer.profiling = true;
  graph::Pipeline pipeline = pipelineOf(GetParam());
  const auto draws = [&](Image& picture) {
    auto output = renderer.render(pipeline, kSize, {"TiledLighting.color"});
    CHECK(static_cast<bool>(output), "{}", output.error().message);
    picture = testing::asFloatRgb(output->kept.at("TiledLighting.color"));
    for (const graph::StepProfile& step : output->profile.steps)
      if (step.row == "PrefilteredShadows") return step.counters.draws;
    return std::uint64_t{0};
  };
  Image first, again, moved;
  EXPECT_GT(draws(first), 0u);
  EXPECT_EQ(draws(again), 0u);
  EXPECT_TRUE(std::ranges::equal(first.bytes(), again.bytes()));

  const auto box = static_cast<std::uint32_t>(scene.objects.size() - 1);
  scene.nodes[scene.objects[box].node].translation.x += 0.4f;
  updateTransforms(scene);
  updateMoved(testing::device(), renderer.gpuScene, std::array{box});
  EXPECT_GT(draws(moved), 0u);
  EXPECT_FALSE(std::ranges::equal(first.bytes(), moved.bytes()));
  EXPECT_TRUE(std::ranges::equal(moved.bytes(), pictureOf(scene, pipeline).bytes()));

  // Other values of its parameters, too.
  for (const auto& [name, value] :
       {std::pair<const char*, graph::Value>{"kernel", std::int64_t{23}},
        {"resolution", std::string("quarter")},
        {"penumbra", std::string(GetParam().penumbra == "light" ? "kernel" : "light")}}) {
    pipeline.passes[4].params[name] = value;
    EXPECT_GT(draws(again), 0u) << name;
    EXPECT_TRUE(std::ranges::equal(again.bytes(), pictureOf(scene, pipeline).bytes())) << name;
  }
}

TEST_P(PrefilteredShadows, WithoutThemLightsHaveHardShadows) {
  scene::Scene scene = testing::emptyScene();
  testing::addWall(scene, kWall);
  testing::addBox(scene, {0, 0, -4}, vec3(0.6f));
  addLamp(scene, GetParam().kind, {3, 1.5f, -1}, {0, 0, -4});
  graph::Pipeline pipeline = pipelineOf(GetParam());
  const Image with = pictureOf(scene, pipeline);
  pipeline.passes[4].enabled = false;
  const Image without = pictureOf(scene, pipeline);
  pipeline.passes[5].params["shadows"] = std::string("hard");
  EXPECT_TRUE(std::ranges::equal(without.bytes(), pictureOf(scene, pipeline).bytes()));
  EXPECT_FALSE(std::ranges::equal(without.bytes(), with.bytes()));
}

// The spread of a penumbra over the wall is that of a disc: half its radius at this distance. A
// spot lamp beside the camera throws the shadow of a half-plane half way to the wall.
TEST(PrefilteredPenumbra, HasTheDeviationOfADiscs) {
  constexpr uvec2 kPicture{513, 129};
  for (const float radius : {0.2f, 0.4f, 0.8f}) {
    scene::Scene scene = testing::emptyScene();
    testing::addWall(scene, kWall);
    testing::addBox(scene, {-20, 0, -0.5f * kWall}, {40, 40, 1e-3f});
    addLamp(scene, scene::LightKind::Spot, {-1, 0.5f, 0}, {-1, 0.5f, -kWall});
    scene.lights.back().radius = radius;
    updateTransforms(scene);
    graph::Pipeline pipeline =
        pipelineOf({.name = {}, .kind = {}, .method = "lispsm", .penumbra = "light"});
    pipeline.passes[3].params["localSize"] = std::int64_t{1024};
    const auto picture = [&](const graph::Pipeline& rows) {
      return testing::asFloatRgb(testing::valueOf(scene, rows, kPicture, "TiledLighting.color"));
    };
    const Image soft = picture(pipeline), lit = picture(unshadowed());
    const int y = kPicture.y / 2;
    const auto share = [&](int x) {
      return static_cast<double>(soft.pixel<float>(x, y)[1] / lit.pixel<float>(x, y)[1]);
    };
    const double aspect = static_cast<double>(kPicture.x) / kPicture.y;
    const double metre =
        kPicture.x / (2. * kWall * std::tan(0.5 * scene.cameras[0].fovY) * aspect);  // px
    double sum = 0, first = 0, second = 0;  // of where the share changes
    const int middle = kPicture.x / 2;
    for (int x = middle; x < middle + static_cast<int>(4. * metre); ++x) {  // of the wall's 5 m
      const double change = share(x + 1) - share(x);
      sum += change, first += change * x, second += change * x * x;
    }
    const double deviation = std::sqrt(second / sum - std::pow(first / sum, 2)) / metre;
    EXPECT_NEAR(sum, 1., 0.02) << radius;
    EXPECT_NEAR(deviation, 0.5 * radius, 0.1 * 0.5 * radius) << radius;
  }
  testing::expectNoDebugMessages();
}

// What leaks through two or three cards behind each other, of which the last covers all the light's
// way: in truth the wall is dark.
class LightBleeding : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Through, LightBleeding, ::testing::Values(2, 3));

// The share that four moments leave to depth 10 behind cards at 1, 3 and 8.5 m with these weights:
// that of a distribution of three depths, one of which is 10.
double leftBehind(double a, double b, double c) {
  const std::array<std::pair<double, double>, 3> cards{{{1, a}, {3, b}, {8.5, c}}};
  const auto central = [&](double mean, int power) {
    double sum = 0;
    for (const auto& [z, weight] : cards) sum += weight * std::pow(z - mean, power);
    return sum;
  };
  const double mean = central(0, 1), deviation = std::sqrt(central(mean, 2));
  const double t = (10 - mean) / deviation, skewness = central(mean, 3) / std::pow(deviation, 3);
  const double d = central(mean, 4) / std::pow(deviation, 4) - skewness * skewness - 1;
  const double q = t * t - skewness * t - 1;
  return 1 / (1 + t * t + q * q / std::max(d, 1e-12));
}

TEST_P(LightBleeding, IsWhatFourMomentsCannotTell) {
  const int depths = GetParam();
  scene::Scene scene = testing::emptyScene();
  testing::addWall(scene, 1.f);
  const float eye = 9.f;
  const auto card = [&](float depth, float left, float right) {  // edges at the light's x / z
    testing::addBox(scene, {0.5f * (left + right) * depth, 0, eye - depth},
                    {(right - left) * depth, 4.f, 1e-3f});
  };
  card(1.f, -0.4f, 0.f);
  if (depths == 3) card(3.f, -0.4f, 0.001f);
  card(8.5f, -0.4f, 0.4f);
  addLamp(scene, scene::LightKind::Spot, {0, 0, eye}, {0, 0, 0});
  graph::Pipeline pipeline = pipelineOf(
      {.name = {}, .kind = scene::LightKind::Spot, .method = "lispsm", .penumbra = "kernel"});
  pipeline.passes[4].params["kernel"] = std::int64_t{23};
  const Image found = pictureOf(scene, pipeline), lit = pictureOf(scene, unshadowed());
  double leaks = 0;
  for (int y = 8; y < 57; ++y)
    for (int x = 8; x < 57; ++x)
      leaks = std::max(
          leaks, static_cast<double>(found.pixel<float>(x, y)[1] / lit.pixel<float>(x, y)[1]));
  double bound = 0;
  for (int a = 0; a <= 100; ++a)
    for (int b = 0; a + b <= 100 && (depths == 3 || b == 0); ++b)
      if (a + b > 0 && a + b < 100)
        bound = std::max(bound, leftBehind(0.01 * a, 0.01 * b, 0.01 * (100 - a - b)));
  std::printf("%d depths: %.4f leaks, at most %.4f\n", depths, leaks, bound);
  if (depths == 2) {
    EXPECT_LT(leaks, 0.01) << "two depths are told exactly";
  } else {
    EXPECT_GT(leaks, 0.05) << "else the scene shows nothing";
    EXPECT_LT(leaks, bound + 0.01);
  }
}

}  // namespace
}  // namespace lucerna
