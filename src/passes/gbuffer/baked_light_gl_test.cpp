// Baked light as the passes show it, against maps interpolated on the CPU.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>

#include "core/file.hpp"
#include "core/test_folder.hpp"
#include "support/mirrors.hpp"
#include "support/testing.hpp"

namespace lucerna {
namespace {

constexpr uvec2 kPicture{64, 64};
constexpr float kDistance = 3.f;  // m from the camera to the sheets
constexpr vec3 kAlbedo{0.5f, 0.25f, 0.75f};
const std::vector<std::string> kRows = {
    "Cull", "GBuffer", "TiledLighting", "CustomShaders", "Background", "Transparency", "ToneMap"};

graph::Pipeline bakedRows() {
  graph::Pipeline pipeline = testing::rows(kRows);
  pipeline.passes[1].params["baked"] = true;
  return pipeline;
}

// No neighbours alike.
Image noiseMap(int side, std::uint64_t seed) {
  Image map(side, side, 3, ComponentType::F32);
  std::uint64_t state = seed;
  for (float& value : map.as<float>()) {
    state = state * 6364136223846793005ull + 1442695040888963407ull;
    value = 0.5f + 4.f * static_cast<float>(state >> 40) / static_cast<float>(1 << 24);
  }
  return map;
}

Image evenMap(int side, vec3 irradiance) {
  Image map(side, side, 3, ComponentType::F32);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x)
      for (int c = 0; c < 3; ++c) map.pixel<float>(x, y)[c] = irradiance[c];
  return map;
}

// OpenGL 4.5, section 8.14.2, in double precision; u to the right, v downwards.
double bilinear(const Image& map, double u, double v, int channel) {
  const int side = map.width();
  const double x = u * side - 0.5, y = v * side - 0.5;
  const double x0 = std::floor(x), y0 = std::floor(y);
  const auto texel = [&](double tx, double ty) -> double {
    const auto held = [&](double t) { return std::clamp(static_cast<int>(t), 0, side - 1); };
    return map.pixel<float>(held(tx), held(ty))[channel];
  };
  const double fx = x - x0, fy = y - y0;
  return (texel(x0, y0) * (1 - fx) + texel(x0 + 1, y0) * fx) * (1 - fy) +
         (texel(x0, y0 + 1) * (1 - fx) + texel(x0 + 1, y0 + 1) * fx) * fy;
}

// A square of 1 m that fills a map, its top left the map's; -1: without a place in any.
scene::Mesh litSheet(int map) {
  scene::Mesh mesh = sheetMesh();
  const auto index = static_cast<float>(map);
  if (map >= 0) mesh.lightmap = {{0, 1, index}, {1, 1, index}, {1, 0, index}, {0, 0, index}};
  return mesh;
}

void addSheet(scene::Scene& scene, int map, vec3 middle) {
  scene.meshes.push_back(litSheet(map));
  testing::addObject(scene, static_cast<std::uint32_t>(scene.meshes.size() - 1), 0,
                     glm::translate(mat4(1.f), middle));
  updateTransforms(scene);
}

// One material, Phong without highlights, and no sheet yet.
scene::Scene sheetScene() {
  scene::Scene scene = testing::emptyScene();
  scene::Material& material = scene.materials.emplace_back();
  material.model = scene::MaterialModel::Phong;
  material.albedo = vec4(kAlbedo, 1.f);
  return scene;
}

Image picture(const scene::Scene& scene, std::span<const Image> maps,
              const graph::Pipeline& pipeline, const std::string& value) {
  testing::SceneRenderer renderer(scene);
  EXPECT_TRUE(render::upload(testing::device(), renderer.lightmaps, maps));
  auto output = renderer.render(pipeline, kPicture, {value});
  CHECK(static_cast<bool>(output), "{}", output.error().message);
  testing::expectNoDebugMessages();
  return testing::asFloatRgb(output->kept.at(value));
}

// Where the ray through the middle of a pixel meets the sheets' plane.
glm::dvec2 pointOn(const scene::Scene& scene, int x, int y) {
  const glm::dmat4 worldFromClip =
      glm::inverse(glm::dmat4(viewOf(scene, scene.cameras[0], 1.f).clipFromView));
  glm::dvec4 p = worldFromClip *
                 glm::dvec4((x + 0.5) / kPicture.x * 2 - 1, 1 - (y + 0.5) / kPicture.y * 2, 1, 1);
  p /= p.w;
  return glm::dvec2(p) * (kDistance / -p.z);
}

class BakedLight : public ::testing::Test {
 protected:
  void TearDown() override { testing::expectNoDebugMessages(); }
};

// Every pixel that looks at the sheet, of a map without any two like neighbours.
void expectInterpolatedMap(const graph::Pipeline& pipeline, const std::string& value) {
  scene::Scene scene = sheetScene();
  addSheet(scene, 0, {0, 0, -kDistance});
  const std::array maps = {noiseMap(8, 1)};
  const Image found = picture(scene, maps, pipeline, value);
  int compared = 0;
  for (int y = 0; y < found.height(); ++y)
    for (int x = 0; x < found.width(); ++x) {
      const glm::dvec2 p = pointOn(scene, x, y);
      if (std::abs(p.x) > 0.48 || std::abs(p.y) > 0.48) continue;
      ++compared;
      for (int c = 0; c < 3; ++c) {
        const double expected = static_cast<double>(kAlbedo[c]) *
                                bilinear(maps[0], p.x + 0.5, 0.5 - p.y, c) /
                                static_cast<double>(kPi);
        ASSERT_NEAR(found.pixel<float>(x, y)[c], expected, 0.012 * expected + 0.002)
            << "pixel " << x << ", " << y;
      }
    }
  EXPECT_GT(compared, 300);
}

TEST_F(BakedLight, IsAlbedoTimesTheInterpolatedIrradianceOverPi) {
  expectInterpolatedMap(bakedRows(), "TiledLighting.color");
}

TEST_F(BakedLight, IsTheSameDrawnForward) {
  expectInterpolatedMap(testing::rows(testing::kForwardRows), "Forward.color");
}

TEST_F(BakedLight, EachObjectReadsItsOwnMapOrNone) {
  scene::Scene scene = sheetScene();
  addSheet(scene, 1, {-0.75f, 0.75f, -kDistance});
  addSheet(scene, -1, {0.75f, 0.75f, -kDistance});
  addSheet(scene, 0, {-0.75f, -0.75f, -kDistance});
  addSheet(scene, 2, {0.75f, -0.75f, -kDistance});
  const std::array maps = {evenMap(4, {1, 2, 3}), evenMap(4, {4, 5, 6}), evenMap(4, {0, 8, 0})};
  const Image found = picture(scene, maps, bakedRows(), "GBuffer.bakedIrradiance");
  const auto atPoint = [&](vec3 expected, int x, int y) {
    for (int c = 0; c < 3; ++c) EXPECT_EQ(found.pixel<float>(x, y)[c], expected[c]) << x << y;
  };
  atPoint({4, 5, 6}, 16, 16);
  atPoint({0, 0, 0}, 48, 16);
  atPoint({1, 2, 3}, 16, 48);
  atPoint({0, 8, 0}, 48, 48);
  atPoint({0, 0, 0}, 32, 32);  // between them, where nothing is
}

TEST_F(BakedLight, WithoutAnyThePictureIsThatOfTheDeferredPipeline) {
  const scene::Scene scene = testing::sampleScene();
  EXPECT_TRUE(equal(testing::pictureOf(scene, bakedRows(), kPicture),
                    testing::pictureOf(scene, testing::rows(kRows), kPicture)));
  // Maps without a place in them, and places without maps.
  const std::array maps = {evenMap(4, vec3(9))};
  EXPECT_TRUE(equal(picture(scene, maps, bakedRows(), "TiledLighting.color"),
                    picture(scene, {}, testing::rows(kRows), "TiledLighting.color")));
  scene::Scene sheet = sheetScene();
  addSheet(sheet, 0, {0, 0, -kDistance});
  EXPECT_EQ(middleOf(picture(sheet, {}, bakedRows(), "TiledLighting.color")), vec3(0));
}

TEST_F(BakedLight, TheBackOfASurfaceHasNone) {
  scene::Scene scene = sheetScene();
  scene.materials[0].doubleSided = true;
  addSheet(scene, 0, {0, 0, -kDistance});
  const std::array maps = {evenMap(4, vec3(2))};
  EXPECT_GT(middleOf(picture(scene, maps, bakedRows(), "TiledLighting.color")).x, 0.3f);
  scene.nodes[scene.objects[0].node].rotation = glm::angleAxis(kPi, vec3(0, 1, 0));
  updateTransforms(scene);
  EXPECT_EQ(middleOf(picture(scene, maps, bakedRows(), "TiledLighting.color")), vec3(0));
  // A mirror image shows its front again.
  scene.nodes[scene.objects[0].node].scale = vec3(1, 1, -1);
  updateTransforms(scene);
  EXPECT_GT(middleOf(picture(scene, maps, bakedRows(), "TiledLighting.color")).x, 0.3f);
}

// What a highlight of reflectance 1 gives back of light from all around, the mean of all directions
// v to the eye, by the midpoints of a grid of v and of halfway vectors h as D spreads them:
// the mean of 2 (n.v) V 4 (v.h) (n.l) / (n.h).
float highlightShare(double roughness) {
  constexpr int kSteps = 64;
  const double a2 = std::pow(roughness, 4.), pi = static_cast<double>(kPi);
  const auto lambda = [&](double c) { return std::sqrt(c * c * (1 - a2) + a2); };
  double sum = 0;
  for (int i = 0; i < kSteps; ++i)
    for (int j = 0; j < kSteps; ++j)
      for (int k = 0; k < kSteps; ++k) {
        const double nv = (i + 0.5) / kSteps, u = (j + 0.5) / kSteps;
        const double nh = std::sqrt((1 - u) / (1 + (a2 - 1) * u));
        const double side = std::sqrt((1 - nv * nv) * (1 - nh * nh));
        const double vh = nv * nh + side * std::cos(2 * pi * (k + 0.5) / kSteps);
        const double nl = 2 * vh * nh - nv;
        if (vh <= 0 || nl <= 0) continue;
        const double visibility = 0.5 / (nl * lambda(nv) + nv * lambda(nl));
        sum += 2 * nv * visibility * 4 * vh * nl / nh;
      }
  return static_cast<float>(sum / std::pow(kSteps, 3.));
}

TEST_F(BakedLight, OfMetalsIsTheMeanOfTheirHighlights) {
  scene::Scene scene = sheetScene();
  addSheet(scene, 0, {0, 0, -kDistance});
  const std::array maps = {evenMap(4, vec3(2))};
  const vec3 all = kAlbedo * 2.f / kPi;
  scene.materials[0].model = scene::MaterialModel::MetallicRoughness;
  const auto expectShares = [&](vec3 diffuse, vec3 highlight) {
    for (const float roughness : {0.1f, 0.4f, 0.5f, 0.7f, 0.9f, 1.f}) {
      scene.materials[0].roughness = roughness;
      const vec3 expected = diffuse + highlight * highlightShare(roughness);
      const vec3 deferred = middleOf(picture(scene, maps, bakedRows(), "TiledLighting.color"));
      EXPECT_LT(glm::distance(deferred, expected), 0.015f) << roughness;
      const vec3 forward =
          middleOf(picture(scene, maps, testing::rows(testing::kForwardRows), "Forward.color"));
      EXPECT_LT(glm::distance(deferred, forward), 0.01f) << roughness;
    }
  };
  for (const float metallic : {0.f, 0.4f, 1.f}) {
    scene.materials[0].metallic = metallic;
    expectShares(all * (1.f - metallic), all * metallic);
  }
  // Their specular reflectance is beside the diffuse one, which its largest channel dims.
  scene.materials[0].model = scene::MaterialModel::SpecularGlossiness;
  scene.materials[0].specular = vec3(0.5f, 0.25f, 0.f);
  expectShares(0.5f * all, scene.materials[0].specular * 2.f / kPi);
}

TEST_F(BakedLight, UnlitSurfacesReflectNoneAndOcclusionDarkensNone) {
  scene::Scene scene = sheetScene();
  addSheet(scene, 0, {0, 0, -kDistance});
  const std::array maps = {evenMap(4, vec3(2))};
  const auto middle = [&] {
    const vec3 deferred = middleOf(picture(scene, maps, bakedRows(), "TiledLighting.color"));
    const vec3 forward =
        middleOf(picture(scene, maps, testing::rows(testing::kForwardRows), "Forward.color"));
    EXPECT_LT(glm::distance(deferred, forward), 0.01f);
    return deferred;
  };
  scene.textures.push_back(
      {.name = "black", .image = std::make_shared<Image>(1, 1, 3, ComponentType::U8)});
  scene.materials[0].occlusionTexture.texture = 0;
  const vec3 all = kAlbedo * 2.f / kPi;
  EXPECT_LT(glm::distance(middle(), all), 0.01f);
  scene.materials[0].model = scene::MaterialModel::Unlit;
  EXPECT_LT(glm::distance(middle(), kAlbedo), 0.01f);
}

TEST_F(BakedLight, MirrorsAndGlassShowItToo) {
  scene::Scene scene = sheetScene();
  scene.background.color = vec3(0.f);
  addSheet(scene, 0, {0, 0, -kDistance});
  const std::array maps = {evenMap(4, vec3(2))};
  const vec3 all = kAlbedo * 2.f / kPi;
  // Glass of half opacity over black.
  scene.materials[0].alphaMode = scene::AlphaMode::Blend;
  scene.materials[0].albedo.w = 0.5f;
  scene.materials[0].transmission = vec3(1.f);
  EXPECT_LT(
      glm::distance(middleOf(picture(scene, maps, bakedRows(), "Transparency.color")), 0.5f * all),
      0.01f);
  // A lit sheet behind the camera, seen in a full mirror before it.
  scene = sheetScene();
  scene.materials.push_back(scene.materials[0]);
  scene.materials[1].reflectivity = 1.f;
  addSheet(scene, -1, {0, 0, -kDistance});
  scene.objects[0].material = 1;
  addSheet(scene, 0, {0, 0, 1.f});
  scene.nodes[scene.objects[1].node].rotation = glm::angleAxis(kPi, vec3(0, 1, 0));
  updateTransforms(scene);
  graph::Pipeline pipeline = reflecting();
  EXPECT_LT(glm::distance(middleOf(picture(scene, maps, pipeline, "Transparency.color")), all),
            0.01f);
}

TEST_F(BakedLight, ShadersOfMaterialsGetItInShade) {
  const TestFolder folder;
  ASSERT_TRUE(writeText(folder / "twice.frag",
                        "#include \"render/custom_shader.glsl\"\n"
                        "vec3 radianceOf(Surface s) { return 2.0 * shade(s); }\n"));
  scene::Scene scene = sheetScene();
  addSheet(scene, 0, {0, 0, -kDistance});
  scene.materials[0].shader.file = (folder / "twice.frag").string();
  const std::array maps = {evenMap(4, vec3(2))};
  const vec3 twice = 2.f * kAlbedo * 2.f / kPi;
  EXPECT_LT(glm::distance(middleOf(picture(scene, maps, bakedRows(), "Transparency.color")), twice),
            0.01f);
  EXPECT_EQ(middleOf(picture(scene, {}, bakedRows(), "Transparency.color")), vec3(0));
  // The name of the maps is taken, as are those of the material's own textures.
  scene.materials[0].shader.textures = {{.name = "lightmaps", .texture = 0}};
  scene.textures.push_back(
      {.name = "black", .image = std::make_shared<Image>(1, 1, 3, ComponentType::U8)});
  testing::SceneRenderer renderer(scene);
  const auto refused = renderer.render(bakedRows(), kPicture);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("'lightmaps' is set by Lucerna"), std::string::npos);
}

TEST_F(BakedLight, MoreMapsThanLayersAreRefused) {
  testing::SceneRenderer renderer(sheetScene());
  const int most = testing::device().capabilities().maxTextureLayers;
  const std::vector<Image> maps(static_cast<std::size_t>(most) + 1, evenMap(1, vec3(1)));
  const Status refused = render::upload(testing::device(), renderer.lightmaps, maps);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find(fmt::format("at most {} layers", most)),
            std::string::npos);
}

TEST_F(BakedLight, PartsOfMapsChange) {
  scene::Scene scene = sheetScene();
  addSheet(scene, 1, {0, 0, -kDistance});
  std::array maps = {evenMap(8, vec3(1)), evenMap(8, vec3(1))};
  testing::SceneRenderer renderer(scene);
  ASSERT_TRUE(render::upload(testing::device(), renderer.lightmaps, maps));
  maps[1] = evenMap(8, vec3(4));
  const std::array parts = {render::MapPart{.map = 1, .first = {4, 0}, .size = {4, 3}}};
  render::update(testing::device(), renderer.lightmaps, maps, parts);
  for (int map = 0; map < 2; ++map) {
    const Image texels = testing::device().download(renderer.lightmaps.maps, map, false);
    for (int y = 0; y < 8; ++y)
      for (int x = 0; x < 8; ++x)
        EXPECT_EQ(texels.pixel<float>(x, y)[1], map == 1 && x >= 4 && y < 3 ? 4.f : 1.f)
            << map << ": " << x << ", " << y;
  }
}

}  // namespace
}  // namespace lucerna
