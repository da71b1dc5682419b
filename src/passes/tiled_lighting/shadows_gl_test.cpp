// Shadows of known shape: where light arrives and where it does not, for each kind of light and
// map.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>

#include "image/metrics.hpp"
#include "support/testing.hpp"

namespace lucerna {
namespace {

constexpr uvec2 kSize{65, 65};  // odd: the middle pixel looks along the axis
constexpr float kWall = 6.f;    // m before the camera

struct Case {
  std::string name;
  scene::LightKind kind;
  std::string method = "lispsm";
};

std::vector<Case> cases() {
  using enum scene::LightKind;
  return {{"Lispsm", Directional},
          {"Uniform", Directional, "uniform"},
          {"Cascades", Directional, "cascades"},
          {"Spot", Spot},
          {"Point", Point}};
}

graph::Pipeline shadowRows(const std::string& method = "lispsm",
                           const std::vector<std::string>& types = {
                               "Cull", "GBuffer", "CustomShaders", "ShadowMaps", "TiledLighting"}) {
  graph::Pipeline pipeline = testing::rows(types);
  for (graph::PassRow& row : pipeline.passes)
    if (row.type == "ShadowMaps") row.params["method"] = method;
  return pipeline;
}

struct Filter {
  const char* shadows;
  int kernel;
  const char* comparison;
  std::string name() const { return fmt::format("{} {}, {}", shadows, kernel, comparison); }
};
constexpr std::array<Filter, 9> kFilters{{{"hard", 1, "nearest"},
                                          {"hard", 1, "filtered"},
                                          {"hard", 1, "plane"},
                                          {"pcf", 3, "filtered"},
                                          {"pcf", 5, "nearest"},
                                          {"pcf", 5, "plane"},
                                          {"pcf", 11, "filtered"},
                                          {"pcf", 11, "plane"},
                                          {"pcf", 23, "filtered"}}};

void setFilter(graph::Pipeline& pipeline, const Filter& filter) {
  graph::ParamValues& params = pipeline.passes.back().params;
  params["shadows"] = std::string(filter.shadows);
  params["kernel"] = filter.kernel;
  params["comparison"] = std::string(filter.comparison);
}

Image shadowed(const scene::Scene& scene, const graph::Pipeline& pipeline) {
  return testing::valueOf(scene, pipeline, kSize, "TiledLighting.color");
}

void addLamp(scene::Scene& scene, scene::LightKind kind, vec3 eye, vec3 target) {
  scene::Light light;
  light.kind = kind;
  light.intensity = kind == scene::LightKind::Directional ? kPi : 100.f;
  light.outerCone = 1.f;
  light.innerCone = 0.9f;
  testing::addLight(scene, light, eye, target);
}

// A cube of the given side.
void addCube(scene::Scene& scene, vec3 center, float side, std::uint32_t material = 0) {
  testing::addBox(scene, center, vec3(side), material);
}

// A normal map that leans by 40 degrees everywhere.
scene::Texture leaningNormals() {
  Image texel(1, 1, 4, ComponentType::U8);
  const std::array<std::uint8_t, 4> values = {209, 128, 225, 255};
  std::ranges::copy(values, texel.pixel<std::uint8_t>(0, 0));
  return {.name = "leaning", .image = std::make_shared<const Image>(texel)};
}

// The pixel in which the camera of emptyScene() sees a point.
ivec2 pixelOf(const scene::Scene& scene, vec3 pointW) {
  const vec4 clip = viewOf(scene, scene.cameras[0], 1.f).clipFromWorld() * vec4(pointW, 1.f);
  const vec2 uv = vec2(clip) / clip.w * vec2(0.5f, -0.5f) + 0.5f;
  return ivec2(uv * vec2(kSize));
}

class Shadows : public ::testing::TestWithParam<Case> {
 protected:
  void TearDown() override { testing::expectNoDebugMessages(); }
  float at(const Image& image, const scene::Scene& scene, vec3 pointW) const {
    const ivec2 pixel = pixelOf(scene, pointW);
    return testing::colorAt(image, pixel.x, pixel.y).y;
  }
};
INSTANTIATE_TEST_SUITE_P(Of, Shadows, ::testing::ValuesIn(cases()),
                         [](const auto& parameter) { return parameter.param.name; });

// Neither acne nor anything else: a wall that nothing stands before is lit as TiledLighting lights
// it, at every angle of the light, whatever its normal map says.
TEST_P(Shadows, AWallByItselfIsLitAsWithoutShadows) {
  for (const bool leaning : {false, true})
    for (const float degrees : {0.f, 0.007f, 20.f, 45.f, 70.f, 85.f, 89.f}) {
      scene::Scene scene = testing::emptyScene();
      if (leaning) scene.textures.push_back(leaningNormals());
      scene::Material& material = testing::addWall(scene, kWall);
      if (leaning) material.normalTexture.texture = 0;
      const float angle = degrees * kPi / 180.f;
      const vec3 target(0, 0, -kWall);
      const vec3 toLight(0.8f * std::sin(angle), 0.6f * std::sin(angle), std::cos(angle));
      addLamp(scene, GetParam().kind, target + 4.f * toLight, target);
      updateTransforms(scene);
      const Image plain = testing::asFloatRgb(
          testing::valueOf(scene, testing::rows({"Cull", "GBuffer", "TiledLighting"}), kSize,
                           "TiledLighting.color"));
      for (const Filter& filter : kFilters) {
        graph::Pipeline pipeline = shadowRows(GetParam().method);
        setFilter(pipeline, filter);
        const Image found = testing::asFloatRgb(shadowed(scene, pipeline));
        float worst = 0.f;
        for (std::size_t i = 0; i < plain.as<float>().size(); ++i)
          worst = std::max(worst, std::abs(plain.as<float>()[i] - found.as<float>()[i]));
        EXPECT_LE(worst, 1.f / 255.f) << filter.name() << ", light at " << degrees << " degrees"
                                      << (leaning ? ", leaning normals" : "");
      }
    }
}

// Where maps of one light meet, each looks things up where it has been made for them.
TEST_P(Shadows, NoLightLeaksWhereMapsMeet) {
  scene::Scene scene = testing::emptyScene();
  testing::addWall(scene, kWall);
  const vec3 eye(0.1f, 0.2f, -4);
  // Around the lamp, or between a sun and all that is seen.
  if (GetParam().kind == scene::LightKind::Directional) {
    addCube(scene, {0, 0, 50}, 40.f);
    addLamp(scene, GetParam().kind, {0, 0.3f, 4}, {0, 0, -1});
  } else {
    addCube(scene, eye, 0.5f);
    addLamp(scene, GetParam().kind, eye, {0.1f, 0.2f, -6});
  }
  updateTransforms(scene);
  for (const Filter& filter : kFilters) {
    graph::Pipeline pipeline = shadowRows(GetParam().method);
    setFilter(pipeline, filter);
    const Image found = testing::asFloatRgb(shadowed(scene, pipeline));
    EXPECT_EQ(std::ranges::count_if(found.as<float>(), [](float v) { return v > 0.f; }), 0)
        << filter.name();
  }
}

// The shadow lies where straight lines from the light put it; beside it all is lit.
TEST_P(Shadows, ACubeThrowsItsShadowWhereItBelongs) {
  scene::Scene scene = testing::emptyScene();
  testing::addWall(scene, kWall);
  addCube(scene, {0, 0, -4}, 0.4f);
  const vec3 eye(3, 1.5f, -1);  // and past the cube to the wall
  addLamp(scene, GetParam().kind, eye, {0, 0, -4});
  updateTransforms(scene);
  const Image found = shadowed(scene, shadowRows(GetParam().method));
  const vec3 along = vec3(0, 0, -4) - eye;
  const vec3 middle = vec3(0, 0, -4) + along * ((kWall - 4.f) / -along.z);
  EXPECT_EQ(at(found, scene, middle), 0.f);
  for (const vec3 offset :
       {vec3(0.9f, 0, 0), vec3(-0.9f, 0, 0), vec3(0, 0.7f, 0), vec3(0, -0.7f, 0)})
    EXPECT_GT(at(found, scene, middle + offset), 0.01f);
}

// A slab that stands off a wall by less than a texel of the map is wide, and light that grazes
// both: only comparisons along the wall's plane tell them apart.
TEST_P(Shadows, LowReliefThrowsItsShadowByThePlane) {
  constexpr float kSlab = 0.06f, kAngle = 80.f * kPi / 180.f;  // m off the wall
  if (GetParam().kind == scene::LightKind::Directional)
    GTEST_SKIP() << "its maps are fitted to the picture";
  scene::Scene scene = testing::emptyScene();
  testing::addWall(scene, kWall);
  testing::addBox(scene, {0, 0, -kWall}, {1, 3, 2.f * kSlab});
  const vec3 target(0, 0, -kWall), edge(-0.5f, 0, -kWall);
  addLamp(scene, GetParam().kind, target + 4.f * vec3(std::sin(kAngle), 0, std::cos(kAngle)),
          target);
  updateTransforms(scene);
  const float shadow = kSlab * std::tan(kAngle);  // m on the wall, from the slab's edge
  const auto darkFor = [&](const char* comparison) {
    graph::Pipeline pipeline = shadowRows();
    for (graph::PassRow& row : pipeline.passes)
      if (row.type == "ShadowMaps") row.params["localSize"] = std::int64_t{256};
    setFilter(pipeline, {"hard", 1, comparison});
    const Image found = shadowed(scene, pipeline);
    EXPECT_GT(at(found, scene, edge - vec3(2.f * shadow, 0, 0)), 0.01f);
    return at(found, scene, edge - vec3(0.4f * shadow, 0, 0)) == 0.f;
  };
  EXPECT_TRUE(darkFor("plane"));
  EXPECT_FALSE(darkFor("filtered"));
}

// Of the middle pixel.
float brightnessOf(const scene::Scene& scene, const std::string& shadows) {
  graph::Pipeline pipeline = shadowRows();
  pipeline.passes.back().params["shadows"] = shadows;
  return testing::centerOf(shadowed(scene, pipeline)).y;
}

// Where normals for shading see a lamp that the surface itself turns away from, in part or all.
TEST(Horizon, HidesWhatOfALampIsBehindASurfacesPlane) {
  constexpr float kRadius = 0.2f;
  for (const float height : {-0.5f, -0.1f, 0.1f, 0.5f}) {  // m over the plane
    SCOPED_TRACE(height);
    scene::Scene scene = testing::emptyScene();
    testing::addWall(scene, kWall);
    // (1, 0, 1) in the world, before the wall's scale.
    for (vec3& normal : scene.meshes.back().normals) normal = normalize(vec3(10, 0, 0.02f));
    scene::Light light;
    light.intensity = 100.f;
    light.radius = kRadius;
    testing::addLight(scene, light, {3.f, 0, -kWall + height}, {0, 0, -kWall});
    updateTransforms(scene);
    const float open = brightnessOf(scene, "none");
    ASSERT_GT(open, 0.01f);
    EXPECT_FLOAT_EQ(brightnessOf(scene, "hard"), height > 0.f ? open : 0.f);
    // Of a disc that stands on the plane. Where its centre is behind that, maps say that the wall
    // blocks all of it.
    const double share = height < 0.f ? 0. : testing::visibleShareOfDisc(height / kRadius);
    EXPECT_NEAR(brightnessOf(scene, "pcss") / open, share, 0.01f);
  }
  testing::expectNoDebugMessages();
}

// A post as wide as a pixel, far before a wall: neither of its neighbours tells how it is turned.
TEST(Horizon, LeavesLightOnWhatIsAPixelWide) {
  scene::Scene scene = testing::emptyScene();
  testing::addWall(scene, kWall);
  constexpr float kPost = 4.f;  // m before the camera
  const float pixel = 2.f * kPost * std::tan(0.5f * scene.cameras[0].fovY) / kSize.y;  // m there
  testing::addBox(scene, {0, 0, -kPost}, {1.2f * pixel, 2, 0.01f});
  scene::Light light;
  light.intensity = 100.f;
  testing::addLight(scene, light, {2, 1, 0}, {0, 0, -kPost});
  updateTransforms(scene);
  for (const float side : {-1.f, 1.f}) {
    scene.nodes[scene.lights.back().node].translation.x = 2.f * side;
    updateTransforms(scene);
    const float open = brightnessOf(scene, "none");
    ASSERT_GT(open, 0.01f);
    EXPECT_FLOAT_EQ(brightnessOf(scene, "hard"), open) << side;
    EXPECT_FLOAT_EQ(brightnessOf(scene, "pcss"), open) << side;
  }
  testing::expectNoDebugMessages();
}

// The trap: what throws the shadow is not in the picture.
TEST_P(Shadows, CastersBehindTheCameraThrowShadows) {
  scene::Scene scene = testing::emptyScene();
  testing::addWall(scene, kWall);
  addCube(scene, {0, 0, 2}, 0.5f);
  addLamp(scene, GetParam().kind, {0, 0, 4}, {0, 0, -1});
  updateTransforms(scene);
  const Image found = shadowed(scene, shadowRows(GetParam().method));
  EXPECT_EQ(testing::centerOf(found), vec3(0.f));
  EXPECT_GT(at(found, scene, {2.3f, 2.3f, -kWall}), 0.01f);
}

TEST_P(Shadows, OnlyTheBlockedLightIsMissing) {
  scene::Scene scene = testing::emptyScene();
  scene.ambient = vec3(0.25f);
  testing::addWall(scene, kWall);
  addCube(scene, {0, 0, 2}, 0.5f);
  addLamp(scene, scene::LightKind::Directional, {3, 0, 0}, {0, 0, -4});
  updateTransforms(scene);
  const vec3 before = testing::centerOf(shadowed(scene, shadowRows(GetParam().method)));
  addLamp(scene, GetParam().kind, {0, 0, 4}, {0, 0, -1});
  updateTransforms(scene);
  EXPECT_EQ(testing::centerOf(shadowed(scene, shadowRows(GetParam().method))), before);
}

TEST_P(Shadows, LightShinesThroughHolesAndTranslucentSurfaces) {
  for (const auto mode : {scene::AlphaMode::Mask, scene::AlphaMode::Blend}) {
    scene::Scene scene = testing::emptyScene();
    testing::addWall(scene, kWall);
    scene::Material& material = scene.materials.emplace_back();
    material.alphaMode = mode;
    material.albedo.w = 0.3f;  // below the cutoff: a hole everywhere
    addCube(scene, {0, 0, 2}, 0.5f, 1);
    addLamp(scene, GetParam().kind, {0, 0, 4}, {0, 0, -1});
    updateTransforms(scene);
    EXPECT_GT(testing::centerOf(shadowed(scene, shadowRows(GetParam().method))).y, 0.01f);
    scene.materials[1].alphaMode = scene::AlphaMode::Opaque;
    EXPECT_EQ(testing::centerOf(shadowed(scene, shadowRows(GetParam().method))), vec3(0.f));
  }
}

// A material's own shader that knows nothing of light: black in full shadow, and as it was without.
TEST_P(Shadows, PixelsOfCustomShadersDarkenByTheDiffuseShare) {
  const std::string shader = ::testing::TempDir() + "lucerna-unlit.frag";
  std::ofstream(shader) << "#include \"render/custom_shader.glsl\"\n"
                           "vec3 radianceOf(Surface s) { return vec3(1.0); }\n";
  for (const float ambient : {0.f, 0.5f}) {
    scene::Scene scene = testing::emptyScene();
    scene.ambient = vec3(ambient);
    scene::Material& wall = testing::addWall(scene, kWall);
    wall.shader.file = shader;
    addLamp(scene, GetParam().kind, {0, 0, 4}, {0, 0, -1});
    updateTransforms(scene);
    const auto picture = [&](const std::vector<std::string>& types) {
      return testing::valueOf(scene, shadowRows(GetParam().method, types), kSize,
                              types.back() + ".color");
    };
    const std::vector<std::string> own{"Cull", "GBuffer", "CustomShaders"};
    const std::vector<std::string> all{"Cull", "GBuffer", "CustomShaders", "ShadowMaps",
                                       "TiledLighting"};
    const vec3 before = testing::centerOf(picture(own));
    ASSERT_GT(before.x, 0.01f);
    EXPECT_EQ(testing::centerOf(picture(all)), before);
    addCube(scene, {0, 0, 2}, 0.5f, static_cast<std::uint32_t>(scene.materials.size()));
    scene.materials.emplace_back();
    updateTransforms(scene);
    const vec3 after = testing::centerOf(picture(all));
    if (ambient == 0.f) {
      EXPECT_EQ(after, vec3(0.f));
    } else {
      EXPECT_GT(after.x, 0.01f * before.x);
      EXPECT_LT(after.x, before.x);
    }
  }
}

}  // namespace
}  // namespace lucerna
