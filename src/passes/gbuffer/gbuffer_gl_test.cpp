#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <memory>
#include <set>

#include "support/testing.hpp"

namespace lucerna {
namespace {

using glm::dmat4;
using glm::dvec4;

const std::vector<std::string> kRows = {"Cull", "GBuffer", "ShowGBuffer"};

TEST(GBuffer, StoresTypeAndShininessOfEachMaterialExactly) {
  scene::Scene scene = testing::emptyScene();
  for (const int shininess : {0, 1, 32, 127, 128, 254, 255}) {
    scene.objects.clear();
    scene.materials.clear();
    scene::Material& material = testing::addWall(scene, 3.f);
    material.model = scene::MaterialModel::Phong;
    material.shininess = static_cast<float>(shininess);
    const Image texels = testing::valueOf(scene, testing::rows(kRows), {8, 8}, "GBuffer.material");
    const std::uint8_t* texel = texels.pixel<std::uint8_t>(4, 4);
    EXPECT_EQ(texel[0], 1);
    EXPECT_EQ(texel[1], shininess);
  }
  testing::expectNoDebugMessages();
}

TEST(GBuffer, TellsMaterialModelsAndNothingApart) {
  const Image texels =
      testing::valueOf(testing::sampleScene(), testing::rows(kRows), {160, 90}, "GBuffer.material");
  std::set<int> types;
  for (std::size_t i = 0; i < texels.as<std::uint8_t>().size(); i += 4)
    types.insert(texels.as<std::uint8_t>()[i]);
  EXPECT_EQ(types, (std::set<int>{0, 1, 2, 3}));
}

// Depth as drawn, against rays through the pixels' centres: half a pixel or a wrong window shows.
TEST(GBuffer, DepthIsThatOfTheSurfaceAtThePixelsCentreAlsoOffAxis) {
  scene::Scene scene = testing::emptyScene();
  testing::addWall(scene, 4.f);
  scene.nodes[scene.objects[0].node].rotation =
      glm::angleAxis(0.5f, glm::normalize(vec3(0.3f, 1.f, 0.f)));
  updateTransforms(scene);
  const dmat4 objectFromWorld =
      glm::inverse(dmat4(scene.nodes[scene.objects[0].node].worldFromNode));

  constexpr int kWidth = 37, kHeight = 23;
  for (const mat4& clipFromView : {perspectiveReversed(0.6f, 37.f / 23.f, 0.1f, 100.f),
                                   frustumReversed(-0.03f, 0.01f, -0.01f, 0.02f, 0.1f, 100.f)}) {
    scene::View view;
    view.clipFromView = clipFromView;
    testing::SceneRenderer renderer(scene);
    auto output = renderer.render(testing::rows(kRows), view, {kWidth, kHeight}, {"GBuffer.depth"});
    ASSERT_TRUE(output) << output.error().message;
    const Image& depths = output->kept.at("GBuffer.depth");
    const dmat4 worldFromClip = glm::inverse(dmat4(clipFromView));
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const double ndcX = (x + 0.5) / kWidth * 2. - 1.;
        const double ndcY = 1. - (y + 0.5) / kHeight * 2.;
        dvec4 nearPoint = worldFromClip * dvec4(ndcX, ndcY, 1., 1.);
        nearPoint /= nearPoint.w;
        // The eye is the origin: points t * nearPoint; the front side is at z = 0.5 of the cube.
        const dvec4 a = objectFromWorld * dvec4(0, 0, 0, 1);
        const dvec4 b = objectFromWorld * nearPoint;
        const double t = (0.5 - a.z) / (b.z - a.z);
        const double expected = t * -nearPoint.z;
        const float depth = *depths.pixel<float>(x, y);
        const dvec4 p = worldFromClip * dvec4(ndcX, ndcY, depth, 1.);
        const double distance = -p.z / p.w;
        ASSERT_NEAR(distance / expected, 1., 1e-4) << "pixel " << x << ", " << y;
      }
  }
  testing::expectNoDebugMessages();
}

int drawnPixels(const scene::Scene& scene, const graph::Pipeline& pipeline, uvec2 size = {32, 32}) {
  const Image depths = testing::valueOf(scene, pipeline, size, "GBuffer.depth");
  return static_cast<int>(std::ranges::count_if(depths.as<float>(), [](float d) { return d > 0; }));
}

// A square that shows its back to the camera.
scene::Scene turnedSquare() {
  scene::Scene scene = testing::emptyScene();
  scene::Mesh mesh;
  mesh.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  mesh.normals.assign(4, vec3(0, 0, -1));
  mesh.indices = {0, 2, 1, 0, 3, 2};
  mesh.bounds = {vec3(-1, -1, 0), vec3(1, 1, 0)};
  scene.meshes.push_back(mesh);
  scene.materials.emplace_back();
  testing::addObject(scene, 1, 0, glm::translate(mat4(1.f), vec3(0, 0, -3)));
  updateTransforms(scene);
  return scene;
}

TEST(GBuffer, DrawsBackFacesOnlyWhereAsked) {
  scene::Scene scene = turnedSquare();
  graph::Pipeline pipeline = testing::rows(kRows);
  EXPECT_EQ(drawnPixels(scene, pipeline), 0);
  pipeline.passes[1].params["backFaces"] = true;
  const int all = drawnPixels(scene, pipeline);
  EXPECT_GT(all, 100);
  pipeline.passes[1].params.clear();
  scene.materials[0].doubleSided = true;
  EXPECT_EQ(drawnPixels(scene, pipeline), all);
}

TEST(GBuffer, MirroredObjectsShowTheirFrontFaces) {
  scene::Scene scene = turnedSquare();
  scene.nodes[scene.objects[0].node].scale = vec3(1, 1, -1);  // now it faces the camera
  updateTransforms(scene);
  EXPECT_GT(drawnPixels(scene, testing::rows(kRows)), 100);
}

TEST(GBuffer, NormalsFaceTheEyeEverywhere) {
  scene::Scene scene = turnedSquare();
  scene.materials[0].doubleSided = true;
  testing::SceneRenderer renderer(scene);
  graph::Pipeline pipeline = testing::rows(kRows);
  auto output = renderer.render(pipeline, {8, 8});
  ASSERT_TRUE(output) << output.error().message;
  // View-space normal (0, 0, 1) shows as (0.5, 0.5, 1).
  const std::uint8_t* pixel = output->picture.pixel<std::uint8_t>(4, 4);
  EXPECT_NEAR(pixel[0], 128, 1);
  EXPECT_NEAR(pixel[1], 128, 1);
  EXPECT_EQ(pixel[2], 255);
}

// A picture of one grey and one alpha channel, as PNG has it.
TEST(GBuffer, GreyAndAlphaTexturesKeepBoth) {
  for (const auto& [grey, alpha] : {std::pair{40, 255}, std::pair{250, 10}}) {
    scene::Scene scene = testing::emptyScene();
    Image image(1, 1, 2, ComponentType::U8);
    image.as<std::uint8_t>()[0] = static_cast<std::uint8_t>(grey);
    image.as<std::uint8_t>()[1] = static_cast<std::uint8_t>(alpha);
    scene.textures.push_back({.name = "grey", .image = std::make_shared<Image>(image)});
    scene::Material& wall = testing::addWall(scene, 3.f);
    wall.alphaMode = scene::AlphaMode::Mask;
    wall.albedoTexture.texture = 0;
    const Image albedo = testing::valueOf(scene, testing::rows(kRows), {8, 8}, "GBuffer.albedo");
    const std::uint8_t* texel = albedo.pixel<std::uint8_t>(4, 4);
    const int expected = alpha == 255 ? grey : 0;  // below the cutoff nothing is drawn
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(texel[c], expected, 1) << grey << ' ' << alpha;
  }
}

// A tangent along the normal cannot turn a normal map: it must not make the normal NaN either.
TEST(GBuffer, ATangentAlongTheNormalLeavesTheNormalAlone) {
  scene::Scene scene = testing::emptyScene();
  scene::Mesh& cube = scene.meshes[0];
  for (std::size_t i = 0; i < cube.normals.size(); ++i) cube.tangents[i] = vec4(cube.normals[i], 1);
  Image image(1, 1, 3, ComponentType::U8);
  std::ranges::copy(std::array<std::uint8_t, 3>{200, 128, 200}, image.as<std::uint8_t>().begin());
  scene.textures.push_back({.name = "bumps", .image = std::make_shared<Image>(image)});
  testing::addWall(scene, 3.f).normalTexture.texture = 0;
  const Image normals = testing::valueOf(scene, testing::rows(kRows), {8, 8}, "GBuffer.normal");
  // Straight at the eye is the middle of the octahedral square.
  for (int c = 0; c < 2; ++c)
    EXPECT_NEAR(normals.pixel<std::uint16_t>(4, 4)[c], 32768, 32) << "component " << c;
}

TEST(GBuffer, AlphaTestCutsHoles) {
  scene::Scene scene = testing::sampleScene();
  scene.materials[3].doubleSided = false;  // the back side would show through the holes
  std::erase_if(scene.objects, [](const scene::Object& object) { return object.material != 3; });
  const graph::Pipeline pipeline = testing::rows(kRows);
  const uvec2 size(320, 180);  // large enough for the texture's own texels
  const int withHoles = drawnPixels(scene, pipeline, size);
  scene.materials[3].alphaMode = scene::AlphaMode::Opaque;
  const int solid = drawnPixels(scene, pipeline, size);
  EXPECT_GT(withHoles, solid / 4);
  EXPECT_LT(withHoles, solid * 3 / 4);
}

// Nine cubes in a square, 10 m away.
scene::Scene nineCubes() {
  scene::Scene scene = testing::emptyScene();
  scene.materials.emplace_back();
  for (const float y : {-3.f, 0.f, 3.f})
    for (const float x : {-3.f, 0.f, 3.f})
      testing::addObject(scene, 0, 0, glm::translate(mat4(1.f), vec3(x, y, -10)));
  updateTransforms(scene);
  return scene;
}

gpu::Counters countersOfGBuffer(const scene::Scene& scene) {
  testing::SceneRenderer renderer(scene);
  renderer.profiling = true;
  auto output = renderer.render(testing::rows(kRows), {8, 8});
  EXPECT_TRUE(output) << output.error().message;
  for (const graph::StepProfile& step : output->profile.steps)
    if (step.row == "GBuffer") return step.counters;
  ADD_FAILURE() << "GBuffer did not run";
  return {};
}

TEST(GBuffer, ObjectsThatShareAMeshAreInstancesOfOneDraw) {
  scene::Scene scene = nineCubes();
  gpu::Counters counters = countersOfGBuffer(scene);
  EXPECT_EQ(counters.draws, 1u);
  EXPECT_EQ(counters.primitives, 9u * 12);
  // Each stands at its place, with nothing between them: pixels 5 apart are 1.5 m apart.
  constexpr int kSize = 33, kStep = 5;
  const Image depths =
      testing::valueOf(scene, testing::rows(kRows), {kSize, kSize}, "GBuffer.depth");
  for (int y = -2; y <= 2; ++y)
    for (int x = -2; x <= 2; ++x)
      EXPECT_EQ(*depths.pixel<float>(16 + kStep * x, 16 + kStep * y) > 0.f,
                x % 2 == 0 && y % 2 == 0)
          << x << ' ' << y;

  scene.materials.emplace_back();
  scene.objects[4].material = 1;  // which one it is in the middle of the list does not matter
  EXPECT_EQ(countersOfGBuffer(scene).draws, 2u);
  scene.nodes[scene.objects[0].node].scale.x = -1.f;  // mirrored: its front faces turn
  scene.meshes.push_back(scene.meshes[0]);
  scene.objects[8].mesh = 1;
  updateTransforms(scene);
  counters = countersOfGBuffer(scene);
  EXPECT_EQ(counters.draws, 4u);
  EXPECT_EQ(counters.primitives, 9u * 12);
  testing::expectNoDebugMessages();
}

TEST(GBuffer, InstancesDoNotChangeThePicture) {
  scene::Scene scene = testing::sampleScene();
  const Image together = testing::valueOf(scene, testing::rows(kRows), {160, 90}, "GBuffer.albedo");
  // With a mesh of its own for each object, nothing can be merged.
  for (scene::Object& object : scene.objects) {
    scene.meshes.push_back(scene.meshes[object.mesh]);
    object.mesh = static_cast<std::uint32_t>(scene.meshes.size() - 1);
  }
  const Image apart = testing::valueOf(scene, testing::rows(kRows), {160, 90}, "GBuffer.albedo");
  EXPECT_TRUE(std::ranges::equal(together.as<std::uint8_t>(), apart.as<std::uint8_t>()));
}

}  // namespace
}  // namespace lucerna
