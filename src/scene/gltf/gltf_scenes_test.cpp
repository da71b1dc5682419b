// Real scenes: what ../shared/scenes/INDEX.md says of them is what is read.
#include <gmock/gmock.h>

#include <chrono>
#include <filesystem>

#include "scene/gltf/gltf_reader.hpp"

namespace lucerna::scene {
namespace {

namespace fs = std::filesystem;

const fs::path kScenes = fs::path(LUCERNA_SOURCE_DIR) / "../shared/scenes";

struct Expected {
  const char* file;
  std::size_t triangles;
  std::size_t materials;  // that the file names
};

// GoogleTest looks for this name.
void PrintTo(  // NOLINT(readability-identifier-naming)
    const Expected& expected, std::ostream* out) {
  *out << expected.file;
}

class GltfScenes : public testing::TestWithParam<Expected> {};

TEST_P(GltfScenes, HasTheTrianglesOfTheIndex) {
  if (!fs::exists(kScenes)) GTEST_SKIP() << "no ../shared/scenes beside this checkout";
  const auto start = std::chrono::steady_clock::now();
  auto scene = readGltf(kScenes / GetParam().file);
  const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - start;
  ASSERT_TRUE(scene) << scene.error().message;
  updateTransforms(*scene);
  EXPECT_EQ(scene->triangleCount(), GetParam().triangles);
  std::printf("%-60s %8zu triangles %5zu objects %4zu materials %3zu textures %7.1f ms\n",
              GetParam().file, scene->triangleCount(), scene->objects.size(),
              scene->materials.size(), scene->textures.size(), time.count());
  for (const std::string& warning : scene->warnings) std::printf("    %s\n", warning.c_str());
  EXPECT_FALSE(scene->boundsW().empty());
  std::size_t named = scene->materials.size();
  for (const Material& material : scene->materials) named -= material.name == "default";
  EXPECT_EQ(named, GetParam().materials);
  for (const Texture& texture : scene->textures) EXPECT_NE(texture.image, nullptr);
}

INSTANTIATE_TEST_SUITE_P(
    All, GltfScenes,
    testing::Values(
        Expected{"crytek_sponza/gltf/sponza.gltf", 262267, 25},
        Expected{"stanford_dragon/dragon_871k.glb", 871414, 0},
        Expected{"torcs_street-1/street-1.gltf", 25508, 43},
        Expected{"torcs_wheel-2/wheel-2.gltf", 33317, 36},
        Expected{"torcs_car1-trb1/car1-trb1.gltf", 4351, 1},
        Expected{"godot_zdm2/zdm2.glb", 58772, 0},
        Expected{"godot_living_room/living_room.glb", 5088, 7},
        Expected{"playcanvas_house/house.glb", 10497, 2},
        Expected{"bevy_cornell_lightmap/CornellBox.glb", 36, 5},
        Expected{"gltf_features/AlphaBlendModeTest/AlphaBlendModeTest.glb", 61, 6},
        Expected{"gltf_features/VertexColorTest/VertexColorTest.gltf", 36, 2},
        Expected{"gltf_features/MultiUVTest/MultiUVTest.gltf", 12, 1},
        Expected{"gltf_features/lightCulling/lightCulling.gltf", 12, 1},
        Expected{"gltf_features/spotLightTest/spotLightTest.gltf", 12, 1},
        Expected{"gltf_features/lightCameraAnimations/lightCameraAnimations.gltf", 12, 1},
        Expected{"gltf_features/emission_strength/14_emission_strength.gltf", 17280, 18},
        Expected{"gltf_features/gpu_instancing/24_gpu_instancing.gltf", 7656770, 2},
        Expected{"gltf_features/alpha_mask/01_alpha_mask.gltf", 2, 1},
        Expected{"gltf_features/two_uvmaps_orm/12_orm_two_uvmaps.gltf", 12, 1},
        Expected{"gltf_features/Fox/Fox.glb", 576, 1},
        Expected{"gltf_features/AnimatedMorphCube/AnimatedMorphCube.gltf", 12, 1},
        Expected{"gltf_features/BoxMeshopt/BoxMeshopt.gltf", 12, 1},
        Expected{"gltf_features/SimpleSkin/SimpleSkin.gltf", 8, 0},
        Expected{"gltf_features/box_sparse/box_sparse.gltf", 12, 0},
        Expected{"gltf_features/PrimitiveMode_06/Mesh_PrimitiveMode_06.gltf", 2, 0},
        Expected{"gltf_features/TextureSettingsTest/TextureSettingsTest.gltf", 72, 10},
        Expected{"gltf_features/single_vs_double_sided/01_single_vs_double_sided.gltf", 1480, 2}));

TEST(GltfFolders, KenneyCityKitHas21336Triangles) {
  if (!fs::exists(kScenes)) GTEST_SKIP() << "no ../shared/scenes beside this checkout";
  std::size_t files = 0, triangles = 0;
  for (const auto& entry : fs::directory_iterator(kScenes / "kenney_city_kit")) {
    if (entry.path().extension() != ".glb") continue;
    auto scene = readGltf(entry.path());
    ASSERT_TRUE(scene) << scene.error().message;
    ++files;
    triangles += scene->triangleCount();
  }
  EXPECT_EQ(files, 37u);
  EXPECT_EQ(triangles, 21336u);
}

TEST(GltfFolders, PointsAndLinesAreNoTriangles) {
  if (!fs::exists(kScenes)) GTEST_SKIP() << "no ../shared/scenes beside this checkout";
  const auto meshOf = [](const char* number) {
    auto scene = readGltf(kScenes / fmt::format("gltf_features/PrimitiveMode_{0}/"
                                                "Mesh_PrimitiveMode_{0}.gltf",
                                                number));
    EXPECT_TRUE(scene) << scene.error().message;
    EXPECT_THAT(scene->warnings, testing::IsEmpty());
    EXPECT_EQ(scene->triangleCount(), 0u);
    return scene->meshes.at(0);
  };
  EXPECT_EQ(meshOf("00").points.size(), 1024u);
  EXPECT_EQ(meshOf("01").lines.size(), 8u);
  EXPECT_EQ(meshOf("07").points.size(), 1024u);
}

}  // namespace
}  // namespace lucerna::scene
