// The shared shader functions against the same numbers worked out on the CPU.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "core/random.hpp"
#include "render/light_list.hpp"
#include "render/view_data.hpp"
#include "support/testing.hpp"

namespace lucerna::gpu {
std::span<const EmbeddedShader> embeddedShaders_render_gl_test();
}

namespace lucerna::render {
namespace {

using glm::dmat4;
using glm::dvec3;
using glm::dvec4;
using gpu::Format;
using testing::device;

class ShaderTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    device().shaderSources().add(gpu::embeddedShaders_render_gl_test());
  }
  void TearDown() override {
    for (const Error& fault : device().takeErrors()) ADD_FAILURE() << fault.message;
    testing::expectNoDebugMessages();
  }

  static gpu::Texture floatTexture(const Image& image) {
    const Format format = image.channels() == 1 ? Format::R32Float : Format::Rgba32Float;
    gpu::Texture texture = device().createTexture(
        {.format = format, .width = image.width(), .height = image.height()}, "test input");
    device().upload(texture, image);
    return texture;
  }
  static gpu::Texture target(Format format, int width, int height) {
    return device().createTexture({.format = format, .width = width, .height = height}, "test");
  }
  static gpu::ProgramPtr program(const std::string& name) {
    return device().program(
        {.vertex = "gpu/fullscreen.vert", .fragment = "render/test_shaders/" + name + ".frag"});
  }
  // Runs a test shader over the target with one input texture.
  template <typename Bind>
  static void run(const gpu::Texture& out, const std::string& name, Bind bind) {
    const gpu::ProgramPtr shader = program(name);
    gpu::Rendering rendering = device().render({.colors = {{&out}}});
    rendering.use(*shader, {.cull = gpu::Cull::None});
    bind(rendering, *shader);
    rendering.fullscreen();
  }
};

struct Projection {
  const char* name;
  mat4 clipFromView;
  bool orthographic;
};

const std::array kProjections = {
    Projection{"symmetric", perspectiveReversed(0.9f, 37.f / 23.f, 0.1f, 1000.f), false},
    Projection{"infinite far", perspectiveReversed(0.9f, 37.f / 23.f, 0.01f, INFINITY), false},
    Projection{"off-axis", frustumReversed(-0.02f, 0.13f, 0.03f, 0.11f, 0.1f, 500.f), false},
    Projection{"a tile far off the axis", frustumReversed(0.2f, 0.21f, -0.3f, -0.29f, 0.1f, 4000.f),
               false},
    Projection{"orthographic", orthographicReversed(-3.f, 5.f, -1.f, 7.f, 0.5f, 80.f), true},
};

// The point that a projection puts at normalised device coordinates (x, y), `distance` metres along
// the view axis, in double precision.
dvec3 pointAt(const dmat4& clipFromView, double x, double y, double distance) {
  const double z = -distance;
  const double w = clipFromView[2][3] * z + clipFromView[3][3];
  return {(x * w - clipFromView[2][0] * z - clipFromView[3][0]) / clipFromView[0][0],
          (y * w - clipFromView[2][1] * z - clipFromView[3][1]) / clipFromView[1][1], z};
}

TEST_F(ShaderTest, PositionReconstructionHitsKnownPointsToOnePartInTenThousand) {
  constexpr int kWidth = 37, kHeight = 23;  // odd, so that a half-pixel error shows
  double worst = 0;
  for (const Projection& projection : kProjections) {
    scene::View view;
    view.clipFromView = projection.clipFromView;
    view.orthographic = projection.orthographic;
    view.worldFromView = glm::inverse(glm::lookAt(vec3(3, -2, 7), vec3(0, 1, 0), vec3(0, 1, 0)));
    view.viewFromWorld = glm::inverse(view.worldFromView);
    ViewData data;
    updateView(device(), data, view, {kWidth, kHeight});

    Random random(7);
    Image depths(kWidth, kHeight, 1, ComponentType::F32);
    std::vector<dvec3> expected;
    const dmat4 clip(view.clipFromView);
    for (int y = 0; y < kHeight; ++y)  // texture row y is target row y
      for (int x = 0; x < kWidth; ++x) {
        const double distance = 0.6 * std::pow(100., random.uniform());
        const dvec3 p =
            pointAt(clip, (x + 0.5) / kWidth * 2. - 1., (y + 0.5) / kHeight * 2. - 1., distance);
        const dvec4 clipped = clip * dvec4(p, 1.);
        *depths.pixel<float>(x, y) = static_cast<float>(clipped.z / clipped.w);
        expected.push_back(p);
      }
    const gpu::Texture depth = floatTexture(depths);
    const gpu::Texture out = target(Format::Rgba32Float, kWidth, kHeight);
    run(out, "position", [&](gpu::Rendering& rendering, const gpu::Program&) {
      rendering.buffer("ViewBlock", data.block);
      rendering.texture("depth", depth, gpu::kNearest);
    });
    const Image positions = device().download(out, 0, false);
    const dmat4 viewFromWorld(view.viewFromWorld);
    for (std::size_t i = 0; i < expected.size(); ++i) {
      const float* p = positions.as<float>().data() + 4 * i;
      const dvec3 found(viewFromWorld * dvec4(p[0], p[1], p[2], 1.));
      const double error = glm::length(found - expected[i]) / glm::length(expected[i]);
      ASSERT_LT(error, 1e-4) << projection.name << ", pixel " << i;
      worst = std::max(worst, error);
    }
  }
  RecordProperty("worst_relative_error", std::to_string(worst));
  std::printf("position reconstruction: worst relative error %.2g\n", worst);
}

// 10^6 directions even on the sphere (Fibonacci lattice), the axes and diagonals among them.
Image directions() {
  constexpr int kSide = 1000;
  Image image(kSide, kSide, 4, ComponentType::F32);
  const double golden = M_PI * (3. - std::sqrt(5.));
  for (int i = 0; i < kSide * kSide; ++i) {
    const double z = 1. - (2. * i + 1.) / (kSide * kSide);
    const double r = std::sqrt(1. - z * z);
    float* texel = image.as<float>().data() + 4 * static_cast<std::size_t>(i);
    texel[0] = static_cast<float>(r * std::cos(golden * i));
    texel[1] = static_cast<float>(r * std::sin(golden * i));
    texel[2] = static_cast<float>(z);
  }
  int special = 0;
  for (const float x : {-1.f, 0.f, 1.f})
    for (const float y : {-1.f, 0.f, 1.f})
      for (const float z : {-1.f, 0.f, 1.f}) {
        if (x == 0.f && y == 0.f && z == 0.f) continue;
        const vec3 n = glm::normalize(vec3(x, y, z));
        std::copy_n(&n.x, 3, image.as<float>().data() + 4 * special++);
      }
  return image;
}

TEST_F(ShaderTest, NormalEncodingIsOffByAtMostATwentiethOfADegree) {
  const Image input = directions();
  const gpu::Texture exact = floatTexture(input);
  const gpu::Texture encoded = target(Format::Rg16Unorm, 1000, 1000);
  const gpu::Texture decoded = target(Format::Rgba32Float, 1000, 1000);
  run(encoded, "encode", [&](gpu::Rendering& rendering, const gpu::Program&) {
    rendering.texture("directions", exact, gpu::kNearest);
  });
  run(decoded, "decode", [&](gpu::Rendering& rendering, const gpu::Program&) {
    rendering.texture("encoded", encoded, gpu::kNearest);
  });
  const Image output = device().download(decoded, 0, false);
  double worst = 0;
  for (std::size_t i = 0; i < 4'000'000; i += 4) {
    const float* a = input.as<float>().data() + i;
    const float* b = output.as<float>().data() + i;
    const dvec3 p(a[0], a[1], a[2]), q(b[0], b[1], b[2]);
    // The sine keeps its precision at small angles, the cosine does not.
    const double angle = std::atan2(glm::length(glm::cross(p, q)), glm::dot(p, q));
    ASSERT_TRUE(std::isfinite(angle)) << "direction " << i / 4;
    worst = std::max(worst, angle);
  }
  const double degrees = worst * 180. / M_PI;
  std::printf("normal encoding: worst angle over 10^6 directions %.5f degrees\n", degrees);
  EXPECT_LE(degrees, 0.05);
  EXPECT_GT(degrees, 0.);
}

TEST_F(ShaderTest, MaterialBytesRoundTripExactly) {
  const gpu::Texture bytes = target(Format::Rgba8Uint, 256, 1);
  const gpu::Texture numbers = target(Format::Rgba32Float, 256, 1);
  run(bytes, "write_bytes", [](gpu::Rendering&, const gpu::Program&) {});
  run(numbers, "read_bytes", [&](gpu::Rendering& rendering, const gpu::Program&) {
    rendering.texture("bytes", bytes, gpu::kNearest);
  });
  const Image read = device().download(numbers);
  for (int x = 0; x < 256; ++x) {
    const float* p = read.pixel<float>(x, 0);
    EXPECT_EQ(p[0], static_cast<float>(x));
    EXPECT_EQ(p[1], static_cast<float>(255 - x));
    EXPECT_EQ(p[2], static_cast<float>(x ^ 0x55));
    EXPECT_EQ(p[3], static_cast<float>((x * 7) & 255));
  }
}

scene::Scene lightScene() {
  scene::Scene scene;
  const auto add = [&](scene::Light light) {
    light.node =
        addNode(scene, "light", glm::inverse(glm::lookAt(vec3(1, 2, 3), vec3(0), vec3(0, 1, 0))));
    scene.lights.push_back(light);
  };
  using scene::LightKind;
  const auto light = [](LightKind kind, float intensity) {
    scene::Light made;
    made.kind = kind;
    made.intensity = intensity;
    return made;
  };
  add(light(LightKind::Directional, 3.f));
  add(light(LightKind::Point, 20.f));
  scene::Light ranged = light(LightKind::Point, 20.f);
  ranged.range = 4.f;
  add(ranged);
  scene::Light constant = light(LightKind::Point, 2.f);
  constant.attenuation = {1, 0, 0};  // no reach: it never falls
  add(constant);
  scene::Light mixed = light(LightKind::Point, 2.f);
  mixed.attenuation = {1, 0.3f, 0.1f};
  mixed.color = {1, 0.5f, 0.2f};
  add(mixed);
  scene::Light spot = light(LightKind::Spot, 30.f);
  spot.innerCone = 0.2f;
  spot.outerCone = 0.6f;
  add(spot);
  scene::Light sharp = light(LightKind::Spot, 9.f);
  sharp.innerCone = sharp.outerCone = 0.5f;
  add(sharp);
  scene::Light focused = light(LightKind::Spot, 9.f);
  focused.outerCone = 1.2f;
  focused.exponent = 4.f;
  add(focused);
  return scene;
}

TEST_F(ShaderTest, LightsGiveWhatTheSceneSaysTheyGive) {
  const scene::Scene scene = lightScene();
  LightList list;
  updateLights(device(), list, scene);
  ASSERT_EQ(list.lights.size(), scene.lights.size());

  constexpr int kSide = 64;
  Random random(3);
  Image points(kSide, kSide, 4, ComponentType::F32);
  for (float& value : points.as<float>()) value = random.uniform(-6.f, 6.f);
  const gpu::Texture input = floatTexture(points);
  const gpu::Texture out = target(Format::Rgba32Float, kSide, kSide);
  for (std::size_t index = 0; index < list.lights.size(); ++index) {
    run(out, "light", [&](gpu::Rendering& rendering, const gpu::Program& program) {
      program.set("lightIndex", static_cast<int>(index));
      rendering.buffer("LightBlock", list.block);
      rendering.texture("points", input, gpu::kNearest);
    });
    const Image results = device().download(out, 0, false);
    const scene::PlacedLight& light = list.lights[index];
    int lit = 0;
    for (std::size_t i = 0; i < points.as<float>().size(); i += 4) {
      const float* p = points.as<float>().data() + i;
      const float* found = results.as<float>().data() + i;
      const bool directional = light.kind == scene::LightKind::Directional;
      const vec3 toLight =
          directional ? -light.directionW : light.positionW - vec3(p[0], p[1], p[2]);
      const float distance = glm::length(toLight);
      const float strength = attenuationAt(light, distance) *
                             coneFactor(light, -glm::dot(toLight / distance, light.directionW));
      const vec3 expected = light.intensity * strength;
      for (int c = 0; c < 3; ++c)
        ASSERT_NEAR(found[c], expected[c], 1e-4f * (1.f + expected[c])) << "light " << index;
      // A light may be passed over only where it gives nothing worth a thousandth.
      if (found[3] == 0.f) {
        ASSERT_LT(strength, 1e-4f) << "light " << index;
      }
      lit += found[3] != 0.f;
    }
    EXPECT_GT(lit, 0) << "light " << index << " reaches no point: the test tests nothing";
  }
}

}  // namespace
}  // namespace lucerna::render
