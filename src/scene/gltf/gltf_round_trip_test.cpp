// Whole scenes written as glTF and read again.
#include <gmock/gmock.h>

#include "core/test_folder.hpp"
#include "scene/gltf/gltf_structure.hpp"
#include "scene/gltf/gltf_writer.hpp"
#include "scene/gltf/same_scene.hpp"
#include "scene/load.hpp"

namespace lucerna::scene {
namespace {

namespace fs = std::filesystem;
using testing::IsEmpty;

const fs::path kScenes = fs::path(LUCERNA_SOURCE_DIR) / "../shared/scenes";

class GltfRoundTrip : public testing::TestWithParam<const char*> {};

TEST_P(GltfRoundTrip, WhatIsReadIsWhatWasWritten) {
  std::string name = GetParam();
  if (!name.starts_with("builtin:")) {
    if (!fs::exists(kScenes)) GTEST_SKIP() << "no ../shared/scenes beside this checkout";
    name = (kScenes / name).string();
  }
  Result<Scene> scene = loadScene(name);
  ASSERT_TRUE(scene) << scene.error().message;
  const TestFolder folder;
  const Result<GltfReport> report = writeGltf(*scene, folder.path());
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_THAT(GltfStructure::faultsOf(folder / "scene.gltf"), IsEmpty());
  const Result<Scene> back = loadScene((folder / "scene.gltf").string());
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_THAT(back->warnings, IsEmpty());
  expectSameTriangles(*scene, *back);
  EXPECT_EQ(back->cameras.size(), scene->cameras.size());
  for (std::size_t i = 0; i < scene->nodes.size(); ++i)
    if (const std::string& given = scene->nodes[i].name; !given.empty()) {
      ASSERT_EQ(back->nodes[i].name, given);
    }
}

INSTANTIATE_TEST_SUITE_P(All, GltfRoundTrip,
                         testing::Values("builtin:cornell", "builtin:atrium",
                                         "torcs_wheel-2/wheel-2.gltf",
                                         "gltf_features/MultiUVTest/MultiUVTest.gltf",
                                         "gltf_features/VertexColorTest/VertexColorTest.gltf"));

}  // namespace
}  // namespace lucerna::scene
