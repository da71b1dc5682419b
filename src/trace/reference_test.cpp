// The reference against what can be worked out by hand.
#include "trace/reference.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/parallel.hpp"
#include "scene/builtin/builtin.hpp"
#include "scene/builtin/penumbra.hpp"
#include "scene/load.hpp"
#include "trace/trace_scenes.hpp"

namespace lucerna::trace {
namespace {

using scene::LightKind;
using testing::addLight;
using testing::addMaterial;
using testing::addSquare;
using testing::emptyScene;

ReferenceSettings settingsOf(const scene::Scene& scene, uvec2 size, int samples) {
  ReferenceSettings settings;
  settings.size = size;
  settings.samples = samples;
  settings.view = testing::viewOf(scene, size);
  return settings;
}

vec3 colorAt(const Image& image, int x, int y) {
  const float* p = image.pixel<float>(x, y);
  return image.channels() == 1 ? vec3(p[0]) : vec3(p[0], p[1], p[2]);
}
vec3 centre(const Image& image) {
  return colorAt(image, image.width() / 2, image.height() / 2);
}

// A wall at z = -2 that fills the picture.
void addWall(scene::Scene& scene, float z = -2.f) {
  addSquare(scene, {0, 0, z}, {9, 0, 0}, {0, 9, 0});
}

TEST(Reference, AWallUnderALightHasLambertsRadiance) {
  scene::Scene scene = emptyScene();
  addMaterial(scene).albedo = vec4(0.5f, 0.25f, 1.f, 1.f);
  addWall(scene);
  scene::Light& light = addLight(scene, LightKind::Point, {0, 0, 2}, {0, 0, -1});
  light.intensity = 32.f;
  for (const float radius : {0.f, 0.5f}) {
    scene.lights[0].radius = radius;
    // The mean over the one pixel's area is not its middle's value: a narrow view.
    scene.cameras[0].fovY = 0.001f;
    const auto picture = renderReference(scene, settingsOf(scene, {1, 1}, 256));
    const float window = std::pow(1.f - std::pow(4.f / 1000.f, 4.f), 2.f);
    const vec3 wanted = vec3(0.5f, 0.25f, 1.f) * (32.f / 16.f * window / kPi);
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(colorAt(picture.color, 0, 0)[c] / wanted[c], 1.f, 1e-4f) << radius;
    EXPECT_EQ(colorAt(picture.direct, 0, 0), colorAt(picture.color, 0, 0));
  }
}

// White surfaces in white light from all around are white, whatever bounces where.
TEST(Reference, AWhiteFurnaceIsWhite) {
  scene::Scene scene = emptyScene();
  scene.ambient = vec3(1.f);
  addMaterial(scene);
  addSquare(scene, {0, -1, -4}, {3, 0, 0}, {0, 0, -3});
  addSquare(scene, {0, 1, -6}, {3, 0, 0}, {0, 2, 0});
  scene.background.color = vec3(1.f);
  for (const int bounces : {0, 1, 4}) {
    auto settings = settingsOf(scene, {16, 12}, 16);
    settings.bounces = bounces;
    const auto picture = renderReference(scene, settings);
    for (const float value : picture.color.as<float>()) EXPECT_NEAR(value, 1.f, 1e-6f) << bounces;
  }
}

// Of a floor at distance x from a wall of height h, endlessly long, cosine-weighted: the wall hides
// (1 - x / sqrt(x^2 + h^2)) / 2.
TEST(Reference, AmbientOcclusionOfACorner) {
  scene::Scene scene = emptyScene();
  addMaterial(scene);
  constexpr float kHeight = 1.f, kEnd = 2000.f;
  addSquare(scene, {0, 0, 0}, {kEnd, 0, 0}, {0, 0, -kEnd});                        // floor
  addSquare(scene, {0, 0.5f * kHeight, 0}, {kEnd, 0, 0}, {0, 0.5f * kHeight, 0});  // wall
  for (const float x : {0.1f, 0.5f, 2.f}) {
    // From above, straight down onto the floor in front of the wall.
    scene.nodes[scene.cameras[0].node].matrix =
        mat4(vec4(1, 0, 0, 0), vec4(0, 0, -1, 0), vec4(0, 1, 0, 0), vec4(0, 0.5f, x, 1));
    updateTransforms(scene);
    scene.cameras[0].fovY = 0.0001f;
    auto settings = settingsOf(scene, {1, 1}, 16384);
    settings.aoRadius = kEnd;
    const auto picture = renderReference(scene, settings);
    const float wanted = 1.f - 0.5f * (1.f - x / std::sqrt(x * x + kHeight * kHeight));
    EXPECT_NEAR(*picture.ao.pixel<float>(0, 0), wanted, 0.002f) << x;
  }
}

// Half-plane and disc: across the penumbra the visible share of the disc is that of a circle cut by
// a straight line.
TEST(Reference, APenumbraIsThatOfTheClosedForm) {
  const scene::builtin::PenumbraOptions options;
  Result<scene::Scene> loaded = scene::loadScene("builtin:penumbra?case=half-plane");
  ASSERT_TRUE(loaded);
  scene::Scene& scene = *loaded;
  const auto edges = scene::builtin::expectedPenumbrae(options);
  ASSERT_FALSE(edges.empty());
  for (const auto& edge : edges) {
    for (const float t : {-0.2f, 0.1f, 0.25f, 0.5f, 0.75f, 0.9f, 1.2f}) {
      // A narrow look at the point, beside the light's axis.
      const vec3 at = glm::mix(edge.litW, edge.darkW, t);
      const vec3 eye = at + vec3(0.f, 0.05f, 0.f);
      scene::Camera camera;
      camera.fovY = 1e-4f;
      camera.near = 0.001f;
      camera.far = 10.f;
      camera.node =
          addNode(scene, "above",
                  mat4(vec4(1, 0, 0, 0), vec4(0, 0, -1, 0), vec4(0, 1, 0, 0), vec4(eye, 1)));
      scene.cameras = {camera};
      updateTransforms(scene);
      auto settings = settingsOf(scene, {1, 1}, 4096);
      settings.visibility = true;
      const auto picture = renderReference(scene, settings);
      const double s = std::clamp(1. - 2. * static_cast<double>(t), -1., 1.);
      const double wanted = 1. - (std::acos(s) - s * std::sqrt(1. - s * s)) / glm::pi<double>();
      EXPECT_NEAR(*picture.visibility[edge.light].pixel<float>(0, 0), wanted, 0.003)
          << edge.name << " at " << t;
    }
  }
}

TEST(Reference, PanesShowWhatIsBehindThem) {
  scene::Scene scene = emptyScene();
  scene::Material& wall = addMaterial(scene);
  wall.albedo = vec4(0);
  wall.emissive = {1, 1, 1};
  addWall(scene, -5.f);
  vec3 wanted(1.f);
  for (const float z : {-4.f, -3.f}) {
    scene::Material& pane = addMaterial(scene);
    pane.alphaMode = scene::AlphaMode::Blend;
    pane.albedo = vec4(0, 0, 0, 0.25f);
    pane.emissive = {0.f, 0.f, -z};
    pane.transmission = {0.5f, 1.f, 1.f};
    wanted = 0.25f * pane.emissive + scene::transmittance(0.25f, pane.transmission) * wanted;
    addWall(scene, z);
  }
  const auto picture = renderReference(scene, settingsOf(scene, {5, 5}, 4));
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(centre(picture.color)[c], wanted[c], 1e-5f);
}

// As the picture shows it: back faces of one-sided surfaces are not there, but they throw shadows.
TEST(Reference, BackFacesAreLookedThroughAndShadow) {
  scene::Scene scene = emptyScene();
  addMaterial(scene);
  addWall(scene, -5.f);
  addMaterial(scene).doubleSided = false;
  addSquare(scene, {0, 0, -3}, {0, 9, 0}, {9, 0, 0});  // faces away
  addLight(scene, LightKind::Directional, vec3(0), {0, 0, -1});
  auto settings = settingsOf(scene, {3, 3}, 2);
  EXPECT_EQ(centre(renderReference(scene, settings).color), vec3(0.f));
  settings.shadows = false;
  EXPECT_NEAR(centre(renderReference(scene, settings).color).x, 1.f / kPi, 1e-6f);
}

// An inside and an outside in one place, each seen from its own side alone.
TEST(Reference, SurfacesInOnePlaceAreAllMet) {
  scene::Scene scene = emptyScene();
  scene.background.color = vec3(1.f);
  scene::Material& glass = addMaterial(scene);
  glass.doubleSided = false;
  glass.alphaMode = scene::AlphaMode::Blend;
  glass.albedo = vec4(0, 0, 0, 0.5f);
  for (const bool turned : {true, false, true, false})
    addSquare(scene, {0, 0, -3}, turned ? vec3(0, 9, 0) : vec3(9, 0, 0),
              turned ? vec3(9, 0, 0) : vec3(0, 9, 0));
  // Not through the diagonals, where two triangles of a square meet.
  const auto picture = renderReference(scene, settingsOf(scene, {6, 4}, 4));
  EXPECT_EQ(colorAt(picture.color, 4, 1), vec3(0.25f)) << "two of the four face the eye";
}

TEST(Reference, MirrorsShowTheOtherSide) {
  scene::Scene scene = emptyScene();
  scene::Material& mirror = addMaterial(scene);
  mirror.reflectivity = 0.75f;
  mirror.albedo = vec4(0);
  mirror.emissive = {0, 0, 1};
  addWall(scene, -5.f);
  addMaterial(scene).emissive = {1, 0, 0};
  addWall(scene, 5.f);
  const auto picture = renderReference(scene, settingsOf(scene, {5, 5}, 4));
  EXPECT_EQ(centre(picture.color), vec3(0.75f, 0, 0.25f));
  EXPECT_EQ(centre(picture.reflection), vec3(0.75f, 0, 0));
}

// A point at distance d is a disc of radius R |d - f| / f on the plane in focus.
TEST(Reference, AThinLensBlursByTheDistanceFromTheFocus) {
  scene::Scene scene = emptyScene();
  addMaterial(scene).emissive = {1, 1, 1};
  constexpr float kLens = 0.1f, kFocus = 2.f, kPixel = 0.002f;  // m, m, tan of its half-angle
  scene.cameras[0].fovY = 2.f * std::atan(kPixel);
  for (const float distance : {2.f, 4.f}) {
    scene.meshes.clear();
    scene.objects.clear();
    // The half-plane x > 0: its edge is spread over 2 R |d - f| / f at the focus.
    addSquare(scene, {50, 0, -distance}, {50, 0, 0}, {0, 50, 0});
    auto settings = settingsOf(scene, {400, 1}, 1024);
    settings.lensRadius = kLens;
    settings.focusDistance = kFocus;
    const auto picture = renderReference(scene, settings);
    const float metres = 2.f * kFocus * kPixel;  // of one pixel, which is the whole height
    int first = 400, last = 0;
    for (int x = 0; x < 400; ++x) {
      const float value = colorAt(picture.color, x, 0).x;
      if (value > 0.f && value < 1.f) first = std::min(first, x), last = std::max(last, x);
    }
    // Across the view, distance d is scaled to the focus plane by f / d.
    const float wanted = 2.f * kLens * std::abs(distance - kFocus) / distance / metres;
    EXPECT_NEAR(static_cast<float>(std::max(last - first + 1, 0)), wanted, 1.5f) << distance;
  }
}

TEST(Reference, PointShadingTakesLightFromTheCentre) {
  scene::Scene scene = emptyScene();
  scene::Material& material = addMaterial(scene);
  material.specular = vec3(1.f);
  material.shininess = 50.f;
  addWall(scene);
  addLight(scene, LightKind::Point, {0.4f, 0, 0}, {0, 0, -1}).radius = 0.2f;
  auto settings = settingsOf(scene, {9, 9}, 64);
  const auto area = renderReference(scene, settings);
  settings.shading = Shading::Point;
  const auto point = renderReference(scene, settings);
  scene.lights[0].radius = 0.f;
  const auto small = renderReference(scene, settings);
  EXPECT_TRUE(std::ranges::equal(point.color.bytes(), small.color.bytes()));
  EXPECT_FALSE(std::ranges::equal(point.color.bytes(), area.color.bytes()));
}

TEST(Reference, IsTheSameForAnyNumberOfThreads) {
  Result<scene::Scene> scene = scene::loadScene("builtin:mirrors");
  ASSERT_TRUE(scene);
  auto settings = settingsOf(*scene, {64, 36}, 20);
  settings.error = 0.05f;
  settings.aoRadius = 1.f;
  settings.bounces = 1;
  std::vector<Image> pictures;
  for (const int threads : {1, 2, 5}) {
    setThreadCount(threads);
    pictures.push_back(renderReference(*scene, settings).color);
  }
  setThreadCount(0);
  EXPECT_TRUE(std::ranges::equal(pictures[0].bytes(), pictures[1].bytes()));
  EXPECT_TRUE(std::ranges::equal(pictures[0].bytes(), pictures[2].bytes()));
  settings.seed = 1;
  EXPECT_FALSE(
      std::ranges::equal(pictures[0].bytes(), renderReference(*scene, settings).color.bytes()));
}

// Pixels end when they are exact enough, and then are: against many more samples, the stated error
// holds as a standard error should.
TEST(Reference, TheStatedErrorIsTrue) {
  Result<scene::Scene> scene = scene::loadScene("builtin:cornell");
  ASSERT_TRUE(scene);
  auto settings = settingsOf(*scene, {48, 27}, 4096);
  settings.error = 0.05f;
  const auto quick = renderReference(*scene, settings);
  EXPECT_LT(quick.meanSamples, 2000.);
  settings.error = 0.f;
  settings.seed = 9;
  const auto exact = renderReference(*scene, settings);
  int outside = 0, hurried = 0, pixels = 0;
  for (int y = 0; y < 27; ++y)
    for (int x = 0; x < 48; ++x) {
      const vec3 a = colorAt(quick.color, x, y), b = colorAt(exact.color, x, y);
      hurried += *quick.error.pixel<float>(x, y) > 0.05f;
      const vec3 share = glm::abs(a - b) / glm::max(b, vec3(0.1f * std::exp2(-scene->exposure)));
      outside += std::max({share.x, share.y, share.z}) > 0.1f;
      ++pixels;
    }
  EXPECT_LE(hurried, 0.01 * pixels) << "of which not even all samples were enough";
  // 4.6 % of normally distributed errors are beyond two standard errors; fewer of stratified ones.
  EXPECT_LT(outside, 0.05 * pixels);
}

}  // namespace
}  // namespace lucerna::trace
