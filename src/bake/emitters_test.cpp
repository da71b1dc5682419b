// What emitting surfaces send out in all, and how.
#include "bake/emitters.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "bake/light_scenes.hpp"
#include "trace/texture_reader.hpp"

namespace lucerna::bake {
namespace {

using namespace testing;

constexpr float kInfinity = std::numeric_limits<float>::infinity();

// Windows in the dark: few and small, no two alike.
std::uint32_t addWindows(scene::Scene& scene) {
  Image image(96, 64, 3, ComponentType::U8);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 96; ++x) {
      const bool lit =
          x % 24 >= 9 && x % 24 < 16 && y % 16 >= 5 && y % 16 < 11 && (x / 24 + y / 16) % 3;
      std::uint8_t* p = image.pixel<std::uint8_t>(x, y);
      p[0] = lit ? static_cast<std::uint8_t>(100 + x) : 0;
      p[1] = lit ? 180 : 0;
      p[2] = lit ? static_cast<std::uint8_t>(60 + y) : 0;
    }
  scene.textures.push_back({.name = "windows", .image = std::make_shared<Image>(std::move(image))});
  return static_cast<std::uint32_t>(scene.textures.size()) - 1;
}

struct Facade {
  scene::Scene scene;
  scene::Material& material;
  Facade() : material(addSurface(scene, vec3(3, 2, 1))) {
    material.emissiveTexture.texture = addWindows(scene);
    addRectangle(scene, {3, 4, 5}, {5.15f, 0, 0}, {0, 3.35f, 0});
  }
  // Of all cells, straight ahead.
  vec3 intensity(float density) const {
    const World world = makeWorld(scene);
    const Charts charts = makeCharts(world, {.density = density});
    const Emitters emitters = findEmitters(world, charts.charts, 0.f, kInfinity);
    EXPECT_FALSE(emitters.nodes.empty());
    return emitters.nodes.empty() ? vec3(0.f) : emitters.nodes[0].emission.intensity;
  }
  // By many points.
  vec3 truth() const {
    const scene::TextureSlot& slot = material.emissiveTexture;
    constexpr int kSteps = 1500;
    glm::dvec3 sum(0.);
    for (int y = 0; y < kSteps; ++y)
      for (int x = 0; x < kSteps; ++x) {
        const vec2 uv = slot.scale * (vec2(x, y) + 0.5f) / float{kSteps};
        const float s = std::sin(slot.rotation), c = std::cos(slot.rotation);
        const vec2 turned(c * uv.x + s * uv.y, -s * uv.x + c * uv.y);
        sum += glm::dvec3(trace::colorAt(scene.textures[0], slot.offset + turned));
      }
    return material.emissive * vec3(sum / double{kSteps} / double{kSteps}) * (10.3f * 6.7f);
  }
};

void expectClose(vec3 found, vec3 wanted, float share, float density) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], wanted[c], share * wanted[c]) << density;
}

TEST(Emitters, SendOutTheSameHoweverFineTheTexels) {
  const Facade facade;
  for (const float density : {1.f, 2.5f, 7.f, 30.f})
    expectClose(facade.intensity(density), facade.truth(), 0.01f, density);
}

TEST(Emitters, FollowTheTexturesTransformAndWrap) {
  for (const scene::Wrap wrap :
       {scene::Wrap::Repeat, scene::Wrap::MirroredRepeat, scene::Wrap::ClampToEdge}) {
    Facade facade;
    facade.scene.textures[0].wrapS = facade.scene.textures[0].wrapT = wrap;
    scene::TextureSlot& slot = facade.material.emissiveTexture;
    slot.offset = {0.3f, -0.2f};
    slot.scale = {1.7f, 0.8f};
    slot.rotation = 0.4f;
    // A picture that is halved, for texels as coarse, spills over the surface's edge: its last
    // column goes on there.
    const float coarse = wrap == scene::Wrap::ClampToEdge ? 0.03f : 0.01f;
    for (const float density : {1.f, 2.5f, 7.f})
      expectClose(facade.intensity(density), facade.truth(), density < 2.f ? coarse : 0.01f,
                  density);
  }
}

TEST(Emitters, OfBothSidesSendOutTwiceAsMuch) {
  Facade facade;
  const vec3 one = facade.intensity(2.5f);
  facade.material.doubleSided = true;
  expectClose(facade.intensity(2.5f), 2.f * one, 1e-5f, 2.5f);
}

// A lamp hangs between two floors that face it.
TEST(Emitters, OfBothSidesLightBoth) {
  for (const bool both : {false, true}) {
    scene::Scene scene;
    addSurface(scene, vec3(1)).doubleSided = both;
    addRectangle(scene, {0, 1, 0}, {0.2f, 0, 0}, {0, 0, 0.2f});  // faces down
    addSurface(scene);
    const auto below = addRectangle(scene, {0, 0, 0}, {0.5f, 0, 0}, {0, 0, -0.5f});
    const auto above = addRectangle(scene, {0, 2, 0}, {0.5f, 0, 0}, {0, 0, 0.5f});
    const auto all = lightAll(planOf(scene, {.density = 10.f}));
    const auto lower = texelsOf(all, below), upper = texelsOf(all, above);
    ASSERT_EQ(lower.size(), upper.size());
    double sumLower = 0., sumUpper = 0.;
    for (std::size_t i = 0; i < lower.size(); ++i) {
      sumLower += lower[i].irradiance.x;
      sumUpper += upper[i].irradiance.x;
    }
    EXPECT_GT(sumLower, 1.);
    EXPECT_NEAR(sumUpper, both ? sumLower : 0., 1e-3 * sumLower);
  }
}

// scene/bake_hints.hpp.
TEST(Emitters, ShineAsTheHintsSay) {
  scene::Scene scene;
  addSurface(scene, vec3(0.5f));
  addRectangle(scene, {0, 5, 0}, {0.05f, 0, 0}, {0, 0, 0.05f});
  addSurface(scene);
  const auto floor = addRectangle(scene, {0, 0, 0}, {6, 0, 0}, {0, 0, -6});
  constexpr float kCut = 0.6f;
  scene.bake.area = scene::AreaLightRule{.cut = kCut, .attenuation = 0.2f, .intensity = 10.f};
  int lit = 0, dark = 0;
  for (const LitTexel& t : texelsOf(lightAll(planOf(scene, {.density = 3.f})), floor)) {
    const vec3 to = vec3(0, 5, 0) - t.positionW;
    const float d = glm::length(to), cosine = to.y / d;
    const float brightness = 0.5f * 10.f * 0.01f / (0.2f * d * d) * cosine;
    const float angle = std::acos(cosine);
    if (std::abs(angle - kCut) < 0.02f) continue;  // at the edge of the cone
    const bool inside = angle < kCut;
    EXPECT_NEAR(t.irradiance.x, inside ? kPi * brightness : 0.f, 2e-3f * brightness) << angle;
    ++(inside ? lit : dark);
  }
  EXPECT_GT(lit, 100);
  EXPECT_GT(dark, 100);
}

}  // namespace
}  // namespace lucerna::bake
