// What emitting surfaces send out in all, and how.
#include "bake/emitters.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "bake/light_scenes.hpp"
#include "bake/polygon_light.hpp"
#include "scene/builtin/mesh_builder.hpp"
#include "trace/texture_reader.hpp"

namespace lucerna::bake {
namespace {

using namespace testing;

constexpr float kInfinity = std::numeric_limits<float>::infinity();

// Of the last material.
void addMesh(scene::Scene& scene, scene::Mesh mesh) {
  scene::Object object;
  object.node = addNode(scene, mesh.name, mat4(1.f));
  object.mesh = static_cast<std::uint32_t>(scene.meshes.size());
  object.material = static_cast<std::uint32_t>(scene.materials.size()) - 1;
  scene.meshes.push_back(std::move(mesh));
  scene.objects.push_back(object);
  updateTransforms(scene);
}

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

Emitters emittersOf(const scene::Scene& scene, float density, bool merged) {
  const World world = makeWorld(scene);
  const Charts charts = makeCharts(world, {.density = density});
  return findEmitters(world, charts.charts, 0.f, kInfinity, {.merged = merged});
}

struct Facade {
  scene::Scene scene;
  scene::Material& material;
  Facade() : material(addSurface(scene, vec3(3, 2, 1))) {
    material.emissiveTexture.texture = addWindows(scene);
    addRectangle(scene, {3, 4, 5}, {5.15f, 0, 0}, {0, 3.35f, 0});
  }
  // Of all cells, straight ahead.
  vec3 intensity(float density, bool merged = true) const {
    const Emitters emitters = emittersOf(scene, density, merged);
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
    for (const bool merged : {false, true})
      expectClose(facade.intensity(density, merged), facade.truth(), 0.01f, density);
}

TEST(Emitters, OfOneColourAreOneCellHoweverFineTheTexels) {
  scene::Scene scene;
  addSurface(scene, vec3(3, 2, 1));
  addRectangle(scene, {3, 4, 5}, {5.15f, 0, 0}, {0, 3.35f, 0});
  for (const float density : {1.f, 10.f, 100.f}) {
    const Emitters emitters = emittersOf(scene, density, true);
    ASSERT_EQ(emitters.cells, 1u) << density;
    const EmitterNode& cell = emitters.nodes[0];
    const float u = glm::length(cell.alongU), v = glm::length(cell.alongV);
    EXPECT_NEAR(std::max(u, v), 10.3f, 1e-3f);
    EXPECT_NEAR(std::min(u, v), 6.7f, 1e-3f);
    EXPECT_NEAR(cell.emission.intensity.x, 3.f * 10.3f * 6.7f, 0.1f);
  }
  EXPECT_EQ(emittersOf(scene, 10.f, false).cells, 103u * 67u);
}

// A fan of twelve facets on a dome, whose outlines are aslant, no two in one plane.
TEST(Emitters, OfManyPlanesAreAsManyCellsAsTheseAsk) {
  scene::Scene scene;
  addSurface(scene, vec3(1));
  scene::builtin::MeshBuilder builder;
  const auto rim = [](int i) {
    const float angle = 2.f * kPi * static_cast<float>(i) / 12.f;
    return vec3(2.f * std::cos(angle), 0.f, 2.f * std::sin(angle));
  };
  for (int i = 0; i < 12; ++i) builder.triangle({vec3(0, 0.5f, 0), rim(i + 1), rim(i)}, {});
  addMesh(scene, builder.take("dome"));
  std::map<float, std::uint64_t> cells;
  vec3 light(0.f);
  for (const float density : {20.f, 200.f}) {
    const Emitters emitters = emittersOf(scene, density, true);
    cells[density] = emitters.cells;
    if (light != vec3(0.f))
      expectClose(emitters.nodes[0].emission.intensity, light, 1e-3f, density);
    light = emitters.nodes[0].emission.intensity;
  }
  EXPECT_LT(cells[200.f], 2 * cells[20.f]);
  EXPECT_LT(cells[200.f], 12u * 60u);
}

TEST(Emitters, OfPicturesAreNoMoreThanThesePixelsAsk) {
  const Facade facade;
  std::uint64_t lit = 0;
  const Image& image = *facade.scene.textures[0].image;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) lit += image.pixel<std::uint8_t>(x, y)[1] > 0 ? 1 : 0;
  // Squares of half a pixel to one, each filtered with its neighbours.
  EXPECT_LT(emittersOf(facade.scene, 100.f, true).cells, 8 * lit);
  EXPECT_GT(emittersOf(facade.scene, 100.f, false).cells, 50 * lit);
}

TEST(Emitters, TooManyAreAnErrorThatSaysWhatFits) {
  const Facade facade;
  const World world = makeWorld(facade.scene);
  const Charts charts = makeCharts(world, {.density = 30.f});
  const Emitters emitters = findEmitters(world, charts.charts, 0.f, kInfinity, {.most = 1000});
  ASSERT_FALSE(emitters.status);
  EXPECT_TRUE(emitters.nodes.empty());
  const std::string& message = emitters.status.error().message;
  EXPECT_NE(message.find("more than 1000 cells"), std::string::npos) << message;
  EXPECT_NE(message.find("areaLights"), std::string::npos) << message;
  // The same with the density that it gives: sqrt(1000 / (10.3 * 6.7)) = 3.8, less for borders.
  EXPECT_NE(message.find("2.7"), std::string::npos) << message;
  const Charts coarse = makeCharts(world, {.density = 2.7f});
  EXPECT_TRUE(findEmitters(world, coarse.charts, 0.f, kInfinity, {.most = 1000}).status);
}

// A triangle whose longest side is aslant to its texels: cells along it are rectangles that are no
// more than as large as what they stand for.
TEST(Emitters, WithOutlinesAslantLightAsTheyAre) {
  for (const float height : {0.25f, 0.5f, 2.f}) {
    scene::Scene scene;
    addSurface(scene, vec3(2));
    const std::array<vec3, 3> corners{vec3(-0.5f, height, -0.5f), vec3(0.5f, height, -0.5f),
                                      vec3(-0.5f, height, 0.5f)};
    scene::builtin::MeshBuilder builder;
    builder.triangle(corners, {});  // faces down
    addMesh(scene, builder.take("lamp"));
    addSurface(scene);
    const auto floor = addRectangle(scene, {0, 0, 0}, {1, 0, 0}, {0, 0, -1});
    float worst = 0.f;
    double squares = 0.;
    const auto texels = texelsOf(lightAll(planOf(scene, {.density = 20.f})), floor);
    ASSERT_FALSE(texels.empty());
    for (const LitTexel& t : texels) {
      const float truth = 2.f * polygonIrradiance(corners, t.positionW, t.normalW);
      const float off = t.irradiance.x / truth - 1.f;
      worst = std::max(worst, std::abs(off));
      squares += double{off} * double{off} / static_cast<double>(texels.size());
    }
    SCOPED_TRACE(fmt::format("{} m: {}, {}", height, worst, std::sqrt(squares)));
    EXPECT_LT(worst, height < 0.3f ? 0.05f : 0.02f);
    EXPECT_LT(std::sqrt(squares), height < 0.3f ? 0.02 : 0.01);
  }
}

// A ball of facets under a ceiling: light may come from within none of them, near or far, or the
// ball would stand in its own light; and where the split of cells changes, from tile to tile,
// brightness may not.
TEST(Emitters, ThatBendShineAlikeNearAndFar) {
  constexpr float kRadius = 0.1f, kHeight = 0.16f;
  scene::Scene scene;
  addSurface(scene, vec3(2));
  scene::builtin::MeshBuilder builder;
  std::array<vec2, 9> globe;
  for (std::size_t i = 0; i < globe.size(); ++i) {
    const float angle = kPi * (static_cast<float>(i) / 8 - 0.5f);
    globe[i] = kRadius * vec2(i % 8 == 0 ? 0.f : std::cos(angle), std::sin(angle));
  }
  builder.lathe(globe, {.segments = 16});
  addMesh(scene, builder.take("globe"));
  addSurface(scene);
  const auto ceiling = addRectangle(scene, {0, kHeight, 0}, {1.6f, 0, 0}, {0, 0, 1.6f});
  for (const Sampling& sampling : {kPreview, kStandard, kFinal}) {
    std::map<std::pair<int, int>, float> shares;  // of what a round ball would give
    for (const LitTexel& t :
         texelsOf(lightAll(planOf(scene, {.density = 20.f, .sampling = sampling})), ceiling)) {
      const float d = glm::length(t.positionW);
      const float truth = 2.f * kPi * kRadius * kRadius * kHeight / (d * d * d);
      shares[{t.texel.x, t.texel.y}] = t.irradiance.x / truth;
    }
    ASSERT_EQ(shares.size(), 64u * 64u);
    float least = 2.f, most = 0.f, step = 0.f;
    for (const auto& [at, share] : shares) {
      least = std::min(least, share);
      most = std::max(most, share);
      for (const auto& next :
           {std::pair(at.first + 1, at.second), std::pair(at.first, at.second + 1)})
        if (const auto found = shares.find(next); found != shares.end())
          step = std::max(step, std::abs(found->second - share));
    }
    SCOPED_TRACE(fmt::format("{} places a texel: {} to {}, steps {}", sampling.positions, least,
                             most, step));
    EXPECT_GT(least, 0.88f);
    EXPECT_LT(most, 1.05f);
    EXPECT_LT(step, 0.06f);
  }
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
