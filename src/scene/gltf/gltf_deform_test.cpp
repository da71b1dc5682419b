// Morph targets and skins in small glTF files.
#include <gmock/gmock.h>

#include "scene/gltf/gltf_file.hpp"

namespace lucerna::scene {
namespace {

using nlohmann::json;
using testing::Contains;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class GltfDeformFile : public GltfFile {
 protected:
  // The square with normals, and two joints: node 1 and its child, node 2.
  json& skinnedSquare() {
    json& primitive = indexedSquare();
    primitive["attributes"]["NORMAL"] = squareNormals();
    primitive["attributes"]["JOINTS_0"] =
        accessor<std::uint8_t>({0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, 5121, "VEC4", 4);
    primitive["attributes"]["WEIGHTS_0"] =
        floats({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4", 4);
    root_["nodes"][0]["skin"] = 0;
    root_["nodes"][0]["translation"] = {100, 100, 100};  // does not count
    root_["nodes"][1]["children"] = {2};
    root_["nodes"][2]["translation"] = {0, 1, 0};
    root_["scenes"][0]["nodes"] = {0, 1};
    root_["skins"][0] = {{"joints", {1, 2}}};
    return root_["meshes"][0]["primitives"][0];
  }
  void bindAt(const std::vector<float>& translations) {
    std::vector<float> matrices;
    for (std::size_t i = 0; i < translations.size(); i += 3)
      matrices.insert(matrices.end(), {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, translations[i],
                                       translations[i + 1], translations[i + 2], 1});
    root_["skins"][0]["inverseBindMatrices"] = floats(matrices, "MAT4", 16);
  }
  json& target(const std::vector<float>& positions) {
    json& targets = root_["meshes"][0]["primitives"][0]["targets"];
    targets.push_back({{"POSITION", floats(positions, "VEC3", 3)}});
    return targets.back();
  }
  // As loadScene() leaves it.
  Result<Scene> readWhole() {
    auto scene = read();
    if (scene) complete(*scene);
    return scene;
  }
};

TEST_F(GltfDeformFile, ASkinPlacesItsMeshWhereTheJointsAre) {
  skinnedSquare();
  bindAt({0, 0, 0, 0, -1, 0});
  root_["nodes"][2]["translation"] = {5, 1, 0};
  const auto scene = readWhole();
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_THAT(scene->warnings, IsEmpty());
  ASSERT_EQ(scene->objects.size(), 1u);
  EXPECT_EQ(scene->objects[0].boundsW.min, vec3(0, 0, 0));
  EXPECT_EQ(scene->objects[0].boundsW.max, vec3(6, 1, 0));  // the upper corners 5 m to the right
  const Mesh& mesh = scene->meshes[scene->objects[0].mesh];
  EXPECT_EQ(mesh.positions[1], vec3(1, 0, 0));
  EXPECT_EQ(mesh.positions[2], vec3(6, 1, 0));
}

TEST_F(GltfDeformFile, WithoutMatricesJointsBindAtTheOrigin) {
  skinnedSquare();
  const auto scene = readWhole();
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->objects[0].boundsW.max, vec3(1, 2, 0));  // joint 1 is 1 m up
}

TEST_F(GltfDeformFile, MoreThanFourJointsCountAndWeightsAreMadeToSumToOne) {
  json& primitive = skinnedSquare();
  primitive["attributes"]["WEIGHTS_0"] = accessor<std::uint8_t>(
      {255, 0, 0, 0, 255, 0, 0, 0, 100, 0, 0, 0, 0, 0, 0, 0}, 5121, "VEC4", 4, true);
  primitive["attributes"]["JOINTS_1"] =
      accessor<std::uint16_t>({0, 0, 0, 0, 0, 0, 0, 0, 0, 9, 0, 0, 0, 0, 0, 0}, 5123, "VEC4", 4);
  primitive["attributes"]["WEIGHTS_1"] = accessor<std::uint16_t>(
      {0, 0, 0, 0, 0, 0, 0, 0, 25700, 0, 0, 0, 0, 0, 0, 0}, 5123, "VEC4", 4, true);
  const auto scene = readWhole();
  ASSERT_TRUE(scene) << scene.error().message;
  const Mesh& mesh = scene->meshes[scene->objects[0].mesh];
  EXPECT_LT(glm::distance(mesh.positions[2], vec3(1, 1.5f, 0)), 1e-5f);  // half of each
  EXPECT_EQ(mesh.positions[3], vec3(0, 2, 0));                           // its first joint alone
  EXPECT_THAT(scene->warnings, ElementsAre(HasSubstr("vertices without a joint's weight")));
}

TEST_F(GltfDeformFile, NegativeAndInfiniteWeightsAreNone) {
  skinnedSquare()["attributes"]["WEIGHTS_0"] =
      floats({1, -1, 0, 0, 1, NAN, 0, 0, 1, 0, INFINITY, 0, 1, 0, 0, 0}, "VEC4", 4);
  const auto scene = readWhole();
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_THAT(scene->warnings, ElementsAre(HasSubstr("weights that are negative or not finite")));
  EXPECT_EQ(scene->objects[0].boundsW.max, vec3(1, 2, 0));
}

TEST_F(GltfDeformFile, ASkinWithoutJointsInTheMeshOrOutsideTheSceneIsLeftOut) {
  json& primitive = skinnedSquare();
  root_["scenes"][0]["nodes"] = {0};
  auto scene = readWhole();
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_THAT(scene->warnings, ElementsAre(HasSubstr("/skins/0/joints/0 is a node outside")));
  EXPECT_EQ(scene->objects[0].boundsW.min, vec3(100.f));

  root_["scenes"][0]["nodes"] = {0, 1};
  primitive["attributes"].erase("JOINTS_0");
  primitive["attributes"].erase("WEIGHTS_0");
  scene = readWhole();
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_THAT(scene->warnings, ElementsAre(HasSubstr("has no JOINTS_0")));
  EXPECT_EQ(scene->objects[0].boundsW.min, vec3(100.f));
}

TEST_F(GltfDeformFile, RefusesWhatASkinCannotBe) {
  json& primitive = skinnedSquare();
  primitive["attributes"].erase("WEIGHTS_0");
  expectRefused({"/meshes/0/primitives/0/attributes: found JOINTS_0 alone", "WEIGHTS_0"});
  const int joints = floats(std::vector<float>(16, 0.f), "VEC4", 4);
  skinnedSquare()["attributes"]["JOINTS_0"] = joints;
  expectRefused({fmt::format("/accessors/{}: found VEC4 of floats", joints), "unsigned bytes"});
  skinnedSquare();
  root_["skins"][0]["joints"] = {1};
  expectRefused({"/skins/0/joints: found 1 joints, but mesh \"mesh 0\" follows joint 1"});
  root_["skins"][0]["joints"] = {1, 77};
  expectRefused({"/skins/0/joints/1: found 77"});
  root_["skins"][0]["joints"] = json::array();
  expectRefused({"/skins/0/joints: found no joints"});
  root_["skins"][0]["joints"] = {1, 2};
  bindAt({0, 0, 0});
  expectRefused({"found 1 MAT4 of floats", "one for each of the 2 joints"});
  bindAt({0, 0, 0, 0, NAN, 0});
  expectRefused({"a matrix that is infinite or not a number"});
  root_["nodes"][0]["skin"] = 1;
  expectRefused({"/nodes/0/skin: found 1"});
}

TEST_F(GltfDeformFile, MorphTargetsAreWeighedByTheNodeThenByTheMesh) {
  indexedSquare()["attributes"]["NORMAL"] = squareNormals();
  target({0, 0, 0, 0, 0, 0, 0, 2, 0, 0, 2, 0});
  target(std::vector<float>(12, 1.f))["NORMAL"] =
      floats({1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0}, "VEC3", 3);
  auto scene = readWhole();
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->objects[0].boundsW.max, vec3(1, 1, 0));
  root_["meshes"][0]["weights"] = {0.5, 0};
  scene = readWhole();
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->objects[0].boundsW.max, vec3(1, 2, 0));
  root_["nodes"][0]["weights"] = {0, 1};
  scene = readWhole();
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->objects[0].boundsW.max, vec3(2, 2, 1));
  const vec3 slanted = glm::normalize(vec3(1, 0, 1));
  EXPECT_LT(glm::distance(scene->meshes[scene->objects[0].mesh].normals[0], slanted), 1e-6f);
}

TEST_F(GltfDeformFile, MorphTargetsMayBeSparseAndQuantized) {
  json& primitive = indexedSquare();
  primitive["attributes"]["NORMAL"] = squareNormals();
  root_["accessors"].push_back(
      {{"componentType", 5122},
       {"count", 4},
       {"type", "VEC3"},
       {"normalized", true},
       {"sparse",
        {{"count", 1},
         {"indices", {{"bufferView", view<std::uint8_t>({2})}, {"componentType", 5121}}},
         {"values", {{"bufferView", view<std::int16_t>({0, 32767, 0})}}}}}});
  primitive["targets"][0]["POSITION"] = root_["accessors"].size() - 1;
  root_["nodes"][0]["weights"] = {3};
  const auto scene = readWhole();
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->meshes[scene->objects[0].mesh].positions[2], vec3(1, 4, 0));
  EXPECT_EQ(scene->meshes[scene->objects[0].mesh].positions[1], vec3(1, 0, 0));
}

// Without normals the triangles are flat, also when they are bent, and targets' normals are
// ignored.
TEST_F(GltfDeformFile, FlatTrianglesStayFlat) {
  indexedSquare();
  target({0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1})["NORMAL"] = squareNormals();
  root_["nodes"][0]["weights"] = {1};
  const auto scene = readWhole();
  ASSERT_TRUE(scene) << scene.error().message;
  const Mesh& mesh = scene->meshes[scene->objects[0].mesh];
  ASSERT_EQ(mesh.positions.size(), 6u);
  EXPECT_EQ(mesh.normals[0], vec3(0, 0, 1));
  const vec3 folded = glm::normalize(glm::cross(vec3(1, 1, 0), vec3(0, 1, 1)));
  EXPECT_LT(glm::distance(mesh.normals[5], folded), 1e-6f);
}

TEST_F(GltfDeformFile, WeightsAreAnimated) {
  indexedSquare()["attributes"]["NORMAL"] = squareNormals();
  target(std::vector<float>(12, 1.f));
  target(std::vector<float>(12, 2.f));
  root_["animations"][0] = {
      {"samplers",
       {{{"input", floats({0, 1}, "SCALAR", 1)}, {"output", floats({0, 0, 1, 0.5}, "SCALAR", 1)}}}},
      {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}}}}};
  auto scene = readWhole();
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_THAT(scene->warnings, IsEmpty());
  EXPECT_THAT(animate(*scene, 0.5f), ElementsAre(0u));
  EXPECT_EQ(scene->objects[0].boundsW.max, vec3(2, 2, 1));  // 0.5 * 1 + 0.25 * 2

  root_["animations"][0]["samplers"][0]["interpolation"] = "CUBICSPLINE";
  expectRefused({"found 4 values for 2 times", "6 a time"});
  root_["meshes"][0]["primitives"][0].erase("targets");
  scene = readWhole();
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_THAT(scene->warnings, ElementsAre(HasSubstr("node 0, which has no morph targets")));
}

TEST_F(GltfDeformFile, RefusesTargetsAndWeightsThatDoNotFit) {
  indexedSquare()["attributes"]["NORMAL"] = squareNormals();
  target({0, 0, 0});
  expectRefused({"/meshes/0/primitives/0/targets/0/POSITION: found an accessor with count 1",
                 "wanted 4, the count of POSITION"});
  json& primitive = root_["meshes"][0]["primitives"][0];
  primitive["targets"][0]["POSITION"] = floats(std::vector<float>(8, 0.f), "VEC2", 2);
  expectRefused({"found VEC2 of floats, wanted VEC3 for POSITION"});
  primitive["targets"][0]["POSITION"] = primitive["attributes"]["NORMAL"];
  root_["nodes"][0]["weights"] = {1, 2};
  expectRefused({"/nodes/0/weights: found 2 weights, wanted 1, one a morph target"});
  root_["nodes"][0].erase("weights");
  root_["meshes"][0]["weights"] = {"x"};
  expectRefused({"/meshes/0/weights/0: found \"x\""});
  root_["meshes"][0].erase("weights");
  json second = primitive;
  second.erase("targets");
  root_["meshes"][0]["primitives"].push_back(second);
  expectRefused({"/meshes/0/primitives/1: found 0 morph targets, wanted 1"});
}

TEST_F(GltfDeformFile, TargetsThatAreNotNumbersAddNothing) {
  indexedSquare()["attributes"]["NORMAL"] = squareNormals();
  target({NAN, 0, 0, INFINITY, 0, 0, 0, 0, 0, 0, 0, 0});
  root_["nodes"][0]["weights"] = {1};
  const auto scene = readWhole();
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_THAT(scene->warnings, ElementsAre(HasSubstr("targets with values that are not finite")));
  EXPECT_EQ(scene->objects[0].boundsW.max, vec3(1, 1, 0));
}

TEST_F(GltfDeformFile, RefusesMoreBentCopiesThanTheFileMakesPlausible) {
  constexpr int kVertices = 30000;
  std::vector<float> positions;
  for (int i = 0; i < kVertices; ++i)
    for (const float value : {static_cast<float>(i), static_cast<float>(i % 2), 0.f})
      positions.push_back(value);
  json& primitive = root_["meshes"][0]["primitives"][0];
  primitive["attributes"]["POSITION"] = floats(positions, "VEC3", 3);
  root_["accessors"].push_back({{"componentType", 5126}, {"count", kVertices}, {"type", "VEC3"}});
  primitive["targets"][0]["POSITION"] = root_["accessors"].size() - 1;  // zeros
  const auto drawBy = [&](int nodes) {
    for (int i = 0; i < nodes; ++i) {
      root_["nodes"][i]["mesh"] = 0;
      root_["scenes"][0]["nodes"][i] = i;
    }
  };
  drawBy(10);
  EXPECT_TRUE(read());
  drawBy(1000);
  expectRefused({"data that expands to"});
}

}  // namespace
}  // namespace lucerna::scene
