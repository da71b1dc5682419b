#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>

#include "core/random.hpp"
#include "image/metrics.hpp"
#include "support/testing.hpp"

namespace lucerna {
namespace {

const std::vector<std::string> kRows = {"Cull",       "GBuffer", "TiledLighting",   "CustomShaders",
                                        "Background", "ToneMap", "GeometrySamples", "Sraa"};

// By the surfaces' depth, and by their normals too.
class Sraa : public ::testing::TestWithParam<std::string> {
 protected:
  void TearDown() override { testing::expectNoDebugMessages(); }

  static graph::PassRow& row(graph::Pipeline& pipeline, const std::string& name) {
    return *std::ranges::find(pipeline.passes, name, &graph::PassRow::name);
  }
  static graph::Pipeline rows(const std::vector<std::string>& types = kRows) {
    graph::Pipeline pipeline = testing::rows(types);
    row(pipeline, "ToneMap").params["operator"] = std::string("linear");
    for (graph::PassRow& each : pipeline.passes)
      if (each.type == "GeometrySamples") each.params["geometry"] = GetParam();
    return pipeline;
  }
};
INSTANTIATE_TEST_SUITE_P(By, Sraa, ::testing::Values("depth", "depth+normal"),
                         [](const auto& parameter) {
                           return parameter.param == "depth" ? "Depth" : "DepthAndNormal";
                         });

// A texture in which every texel differs from its neighbours.
void addNoise(scene::Scene& scene) {
  Image image(64, 64, 4, ComponentType::U8);
  Random random(1);
  for (std::uint8_t& value : image.as<std::uint8_t>())
    value = random.uniform() < 0.5f ? std::uint8_t{0} : std::uint8_t{255};
  for (int i = 3; i < 4 * 64 * 64; i += 4) image.as<std::uint8_t>()[i] = 255;
  scene.textures.push_back({.name = "noise", .image = std::make_shared<Image>(image)});
}

int greatestDifference(const Image& a, const Image& b) {
  int greatest = 0;
  for (std::size_t i = 0; i < a.as<std::uint8_t>().size(); ++i)
    greatest = std::max(greatest, std::abs(a.as<std::uint8_t>()[i] - b.as<std::uint8_t>()[i]));
  return greatest;
}

// The picture before and after, of 8 bits, as a long lens sees it.
std::pair<Image, Image> beforeAndAfter(const scene::Scene& scene, const graph::Pipeline& pipeline,
                                       const std::string& before, const std::string& after) {
  testing::SceneRenderer renderer(scene);
  scene::View view;
  view.clipFromView = perspectiveReversed(0.2f, 1.5f, 0.1f, 1e3f);
  auto output = renderer.render(pipeline, view, {96, 64}, {before, after});
  EXPECT_TRUE(output) << output.error().message;
  return {output->kept.at(before), output->kept.at(after)};
}

// However steeply a plane is seen, and wherever the row stands.
TEST_P(Sraa, LeavesUniformAreasAndTheirTexturesAlone) {
  for (const float degrees : {0.f, 45.f, 78.f}) {
    SCOPED_TRACE(degrees);
    scene::Scene scene = testing::emptyScene();
    addNoise(scene);
    scene::Material& wall = testing::addWall(scene, 10.f);
    wall.model = scene::MaterialModel::Unlit;
    wall.albedoTexture.texture = 0;
    scene::Node& node = scene.nodes[scene.objects.back().node];
    node.scale = vec3(200.f, 200.f, 0.01f);
    node.rotation = glm::angleAxis(glm::radians(degrees), glm::normalize(vec3(1.f, 0.4f, 0.f)));
    updateTransforms(scene);
    const auto [before, after] = beforeAndAfter(scene, rows(), "ToneMap.color", "Sraa.color");
    EXPECT_LE(greatestDifference(before, after), 1);
    EXPECT_GT(pixelMetrics(testing::asFloatRgb(before), Image(96, 64, 3, ComponentType::F32)).rmse,
              0.1)
        << "there is a texture";

    graph::Pipeline radiance =
        rows({"Cull", "GBuffer", "TiledLighting", "GeometrySamples", "Sraa", "ToneMap"});
    graph::PassRow& untouched = radiance.passes.emplace_back(row(radiance, "ToneMap"));
    untouched.name = "Untouched";
    untouched.reads["color"] = "TiledLighting.color";
    const auto [without, with] =
        beforeAndAfter(scene, radiance, "Untouched.color", "ToneMap.color");
    EXPECT_LE(greatestDifference(without, with), 1);
  }
}

// A view in which a pixel is a metre, on things that are 50 m away.
constexpr unsigned kSide = 16;
scene::View pixelView() {
  scene::View view;
  view.clipFromView = orthographicReversed(0, kSide, 0, kSide, 1, 100);
  view.orthographic = true;
  return view;
}

// A sheet over all of the view from `begin` m along the axis on; it is at distance 50 - nearer and
// recedes by `slope` m a pixel along the axis.
void addSheet(scene::Scene& scene, int axis, float begin, float slope, float nearer, vec3 color) {
  scene::Mesh mesh;
  for (const vec2 corner : {vec2(begin, -5), vec2(25, -5), vec2(25, 25), vec2(begin, 25)}) {
    const float z = -50.f + nearer - slope * (corner.x - 8.f);
    mesh.positions.push_back(axis == 0 ? vec3(corner, z) : vec3(corner.y, corner.x, z));
  }
  mesh.normals.assign(4, vec3(0, 0, 1));
  mesh.indices = {0, 1, 2, 0, 2, 3};
  mesh.bounds = {vec3(-5, -5, -100), vec3(25, 25, 0)};
  scene.meshes.push_back(mesh);
  scene::Material& material = scene.materials.emplace_back();
  material.model = scene::MaterialModel::Unlit;
  material.doubleSided = true;
  material.albedo = vec4(color, 1.f);
  testing::addObject(scene, static_cast<std::uint32_t>(scene.meshes.size() - 1),
                     static_cast<std::uint32_t>(scene.materials.size() - 1), mat4(1.f));
}

std::vector<vec2> samplePositions() {
  return testing::device().samplePositions(testing::device().createTexture(
      {.kind = gpu::TextureKind::Multisample2D, .format = gpu::Format::R8Unorm, .samples = 4},
      "positions"));
}

// An edge through a pixel shows the share of its samples that lie beyond it. Steep sheets tell
// where they really lie: half a pixel from its place, each is as near to the other as to itself.
TEST_P(Sraa, UsesTheRealPositionsOfSamples) {
  const std::vector<vec2> positions = samplePositions();
  graph::Pipeline pipeline = rows();
  for (int axis = 0; axis < 2; ++axis)
    for (const bool steep : {false, true})
      for (int step = 0; step < 16; ++step) {
        const float edge = (static_cast<float>(step) + 0.5f) / 16.f;
        scene::Scene scene = testing::emptyScene();
        addSheet(scene, axis, -5.f, steep ? 2.f : 0.f, 0.f, vec3(0.f));
        addSheet(scene, axis, 8.f + edge, steep ? 2.f : 0.f, steep ? 1.f : 5.f, vec3(1.f));
        updateTransforms(scene);
        testing::SceneRenderer renderer(scene);
        auto output = renderer.render(pipeline, pixelView(), {kSide, kSide}, {"Sraa.color"});
        ASSERT_TRUE(output) << output.error().message;
        const Image& image = output->kept.at("Sraa.color");
        const auto shareAt = [&](int along) {
          const int x = axis == 0 ? along : 8, y = axis == 0 ? 8 : kSide - 1 - along;
          return linearFromSrgb(static_cast<float>(image.pixel<std::uint8_t>(x, y)[0]) / 255.f);
        };
        const auto beyond = std::ranges::count_if(
            positions, [&](const vec2& position) { return position[axis] > edge; });
        EXPECT_NEAR(shareAt(7), 0.f, 0.01f);
        EXPECT_NEAR(shareAt(8), static_cast<float>(beyond) / 4.f, 0.05f)
            << "axis " << axis << ", edge at " << edge << (steep ? ", steep" : "");
        EXPECT_NEAR(shareAt(9), 1.f, 0.01f);
      }
}

// Two sheets at one depth that are turned apart: only normals show the edge between them.
TEST_P(Sraa, TellsSurfacesOfOneDepthApartByTheirNormals) {
  const std::vector<vec2> positions = samplePositions();
  for (const float edge : {0.1f, 0.3f, 0.7f, 0.9f}) {
    SCOPED_TRACE(edge);
    scene::Scene scene = testing::emptyScene();
    addSheet(scene, 0, -5.f, 0.f, 0.f, vec3(0.f));
    addSheet(scene, 0, 8.f + edge, 0.f, 1e-4f, vec3(1.f));
    scene.meshes.back().normals.assign(4, vec3(0.6f, 0, 0.8f));
    updateTransforms(scene);
    testing::SceneRenderer renderer(scene);
    auto output = renderer.render(rows(), pixelView(), {kSide, kSide}, {"Sraa.color"});
    ASSERT_TRUE(output) << output.error().message;
    const float found = linearFromSrgb(
        static_cast<float>(output->kept.at("Sraa.color").pixel<std::uint8_t>(8, 8)[0]) / 255.f);
    const auto beyond =
        std::ranges::count_if(positions, [&](const vec2& position) { return position.x > edge; });
    const float unsmoothed = edge < 0.5f ? 1.f : 0.f;
    EXPECT_NEAR(found, GetParam() == "depth" ? unsmoothed : static_cast<float>(beyond) / 4.f,
                0.05f);
  }
}

// A tilted white card before black.
scene::Scene card() {
  scene::Scene scene = testing::emptyScene();
  testing::addWall(scene, 3.f).model = scene::MaterialModel::Unlit;
  scene::Node& node = scene.nodes[scene.objects.back().node];
  node.scale = vec3(2.f, 2.f, 0.01f);
  node.rotation = glm::angleAxis(0.1f, vec3(0, 0, 1));
  updateTransforms(scene);
  return scene;
}

// Of a value, against the picture of ToneMap drawn eight times as large and averaged.
class Distance {
 public:
  Distance(const scene::Scene& scene, const graph::Pipeline& pipeline)
      : scene_(scene), truth_(kPixels, kPixels, 3, ComponentType::F32) {
    const Image large =
        testing::valueOf(scene, pipeline, uvec2(kFactor * kPixels), "ToneMap.color");
    for (int y = 0; y < large.height(); ++y)
      for (int x = 0; x < large.width(); ++x)
        for (int c = 0; c < 3; ++c)
          truth_.pixel<float>(x / kFactor, y / kFactor)[c] +=
              linearFromSrgb(static_cast<float>(large.pixel<std::uint8_t>(x, y)[c]) / 255.f) /
              (kFactor * kFactor);
    for (float& value : truth_.as<float>()) value = srgbFromLinear(value);
  }
  double psnr(const graph::Pipeline& pipeline, const std::string& value) const {
    const Image image = testing::valueOf(scene_, pipeline, uvec2(kPixels), value);
    return pixelMetrics(truth_, testing::asFloatRgb(image)).psnr;
  }

 private:
  static constexpr int kPixels = 96, kFactor = 8;
  const scene::Scene& scene_;
  Image truth_;
};

TEST_P(Sraa, ComesNearerToTheTruthThanFxaa) {
  const scene::Scene scene = card();
  const Distance distance(scene, rows());
  const graph::Pipeline fxaa =
      rows({"Cull", "GBuffer", "TiledLighting", "Background", "ToneMap", "Fxaa"});
  EXPECT_GT(distance.psnr(rows(), "Sraa.color"), distance.psnr(rows(), "ToneMap.color") + 6.);
  EXPECT_GT(distance.psnr(rows(), "Sraa.color"), distance.psnr(fxaa, "Fxaa.color") + 1.);
}

TEST_P(Sraa, SmoothsEdgesBehindGlass) {
  scene::Scene scene = card();
  scene::Material& glass = testing::addWall(scene, 2.f);
  glass.model = scene::MaterialModel::Unlit;
  glass.alphaMode = scene::AlphaMode::Blend;
  glass.albedo = vec4(0.2f, 0.4f, 0.8f, 0.5f);
  std::vector<std::string> types = kRows;
  types.insert(std::ranges::find(types, "ToneMap"), "Transparency");
  const graph::Pipeline pipeline = rows(types);
  const Distance distance(scene, pipeline);
  EXPECT_GT(distance.psnr(pipeline, "Sraa.color"), distance.psnr(pipeline, "ToneMap.color") + 5.);
}

TEST_P(Sraa, SmoothsEdgesOfShadersOfTheirOwn) {
  const auto file = std::filesystem::path(::testing::TempDir()) / "lucerna_sraa.frag";
  std::ofstream(file) << "#include \"render/custom_shader.glsl\"\n"
                         "vec3 radianceOf(Surface s) { return vec3(1.0); }\n";
  scene::Scene scene = card();
  scene.materials.back().shader.file = file.string();
  const Distance distance(scene, rows());
  EXPECT_GT(distance.psnr(rows(), "Sraa.color"), distance.psnr(rows(), "ToneMap.color") + 6.);
}

// The holes of an alpha test have edges within pixels, too.
TEST_P(Sraa, SmoothsEdgesOfHoles) {
  scene::Scene scene = card();
  Image image(2, 2, 4, ComponentType::U8);
  std::ranges::fill(image.as<std::uint8_t>(), std::uint8_t{255});
  image.pixel<std::uint8_t>(0, 0)[3] = image.pixel<std::uint8_t>(1, 1)[3] = 0;
  scene.textures.push_back({.name = "holes", .image = std::make_shared<Image>(image)});
  scene::Material& material = scene.materials.back();
  material.alphaMode = scene::AlphaMode::Mask;
  material.albedoTexture.texture = 0;
  scene.nodes[scene.objects.back().node].scale = vec3(8.f, 8.f, 0.01f);  // no other edges
  updateTransforms(scene);
  const Distance distance(scene, rows());
  EXPECT_GT(distance.psnr(rows(), "Sraa.color"), distance.psnr(rows(), "ToneMap.color") + 4.);
}

// Front and back of a square that shows its back, drawn by GBuffer if told.
TEST_P(Sraa, DrawsTheBackFacesThatGBufferDraws) {
  scene::Scene scene = testing::emptyScene();
  addSheet(scene, 0, 8.3f, 0.f, 0.f, vec3(1.f));
  std::ranges::reverse(scene.meshes.back().indices);
  scene.materials.back().doubleSided = false;
  updateTransforms(scene);
  graph::Pipeline pipeline = rows();
  row(pipeline, "GBuffer").params["backFaces"] = true;
  row(pipeline, "GeometrySamples").params["backFaces"] = true;
  testing::SceneRenderer renderer(scene);
  auto output = renderer.render(pipeline, pixelView(), {kSide, kSide}, {"Sraa.color"});
  ASSERT_TRUE(output) << output.error().message;
  const Image& image = output->kept.at("Sraa.color");
  const int value = image.pixel<std::uint8_t>(8, 8)[0];
  EXPECT_GT(value, 100) << "part of the pixel";
  EXPECT_LT(value, 250);
  EXPECT_EQ(image.pixel<std::uint8_t>(9, 8)[0], 255);
}

TEST_P(Sraa, PassesThePictureThroughWithoutSamples) {
  const scene::Scene scene = testing::sampleScene();
  graph::Pipeline pipeline = rows();
  row(pipeline, "GeometrySamples").enabled = false;
  const auto [before, after] = beforeAndAfter(scene, pipeline, "ToneMap.color", "Sraa.color");
  EXPECT_EQ(greatestDifference(before, after), 0);
}

TEST_P(Sraa, IsNotThereWhileItIsDisabled) {
  const scene::Scene scene = testing::sampleScene();
  std::vector<std::string> types = kRows;
  types.emplace_back("Fxaa");  // reads what it leaves
  graph::Pipeline disabled = rows(types), without = rows(types);
  row(disabled, "Sraa").enabled = false;
  std::erase_if(without.passes, [](const graph::PassRow& r) { return r.type == "Sraa"; });
  const Image a = testing::valueOf(scene, disabled, {96, 64}, "Fxaa.color");
  const Image b = testing::valueOf(scene, without, {96, 64}, "Fxaa.color");
  EXPECT_TRUE(std::ranges::equal(a.bytes(), b.bytes()));
}

TEST_P(Sraa, MayStandTwice) {
  const scene::Scene scene = card();
  graph::Pipeline pipeline = rows();
  graph::PassRow& again = pipeline.passes.emplace_back(row(pipeline, "Sraa"));
  again.name = "Again";
  const Distance distance(scene, rows());
  EXPECT_GT(distance.psnr(pipeline, "Again.color"), distance.psnr(pipeline, "ToneMap.color") + 4.);
}

}  // namespace
}  // namespace lucerna
