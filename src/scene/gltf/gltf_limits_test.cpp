// Small files that ask for much, and large ones that ask for what they hold.
#include <gmock/gmock.h>

#include "image/image_file.hpp"
#include "scene/gltf/gltf_file.hpp"

namespace lucerna::scene {
namespace {

using nlohmann::json;
using testing::Contains;
using testing::HasSubstr;
using testing::SizeIs;

constexpr const char* kTooMuch = "found data that expands to";

// A thousand primitives, a hundred thousand times.
TEST_F(GltfFile, RefusesMoreObjectsThanTheFileMakesPlausible) {
  const json primitive = indexedSquare();
  for (int i = 1; i < 1000; ++i) root_["meshes"][0]["primitives"].push_back(primitive);
  root_["accessors"].push_back({{"componentType", 5126}, {"count", 100'000}, {"type", "VEC3"}});
  root_["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] =
      root_["accessors"].size() - 1;
  expectRefused({"/nodes/0/extensions/EXT_mesh_gpu_instancing", kTooMuch});
}

TEST_F(GltfFile, RefusesMoreWeightsThanTheFileMakesPlausible) {
  constexpr int kMany = 10'000;
  json& primitive = indexedSquare();
  for (int i = 0; i < kMany; ++i) {
    primitive["targets"].push_back(json::object());
    root_["nodes"][i]["mesh"] = 0;
    root_["scenes"][0]["nodes"][i] = i;
  }
  root_["meshes"][0]["weights"] = std::vector<float>(kMany, 0.5f);
  expectRefused({"/nodes/", kTooMuch});
}

// Three vertices, but each pose of them takes a matrix a joint.
TEST_F(GltfFile, RefusesMorePosesThanTheFileMakesPlausible) {
  constexpr int kMany = 3000;
  json& attributes = indexedSquare()["attributes"];
  attributes["JOINTS_0"] = accessor(std::vector<std::uint8_t>(16, 0), 5121, "VEC4", 4);
  attributes["WEIGHTS_0"] = floats(std::vector<float>(16, 0.25f), "VEC4", 4);
  root_["skins"][0]["joints"] = std::vector<int>(kMany, 0);
  for (int i = 0; i < kMany; ++i) {
    root_["nodes"][i] = {{"mesh", 0}, {"skin", 0}};
    root_["scenes"][0]["nodes"][i] = i;
  }
  expectRefused({kTooMuch});
}

// A name of a megabyte would be copied for each of what is made of it.
TEST_F(GltfFile, LongNamesAreCut) {
  indexedSquare();
  root_["meshes"][0]["name"] = std::string(249, 'a') + "\xC3\xA9" + std::string(1 << 20, 'b');
  const auto scene = read();
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->meshes[0].name, std::string(249, 'a') + "...");
}

TEST_F(GltfFile, ImagesOfOneViewAreOnePicture) {
  const Bytes png = *encodeImage("a.png", Image(2, 2, 3, ComponentType::U8));
  indexedSquare()["material"] = 0;
  const int picture = view(png);
  root_["images"] = {{{"bufferView", picture}}, {{"bufferView", picture}, {"name", "again"}}};
  root_["textures"] = {{{"source", 0}}, {{"source", 1}}};
  root_["materials"][0] = {{"emissiveTexture", {{"index", 0}}},
                           {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 1}}}}}};
  const auto scene = read();
  ASSERT_TRUE(scene) << scene.error().message;
  ASSERT_THAT(scene->textures, SizeIs(2));
  EXPECT_EQ(scene->textures[0].image->width(), 2);
  EXPECT_EQ(scene->textures[0].image, scene->textures[1].image);
}

// Each of these asked for a search through the document: two hundred billion steps.
TEST_F(GltfFile, AFileOfManyThingsIsReadInOnePass) {
  constexpr int kMany = 100'000;
  indexedSquare();
  root_["skins"] = std::vector<json>(kMany, {{"joints", {0}}});
  root_["animations"] =
      std::vector<json>(kMany, {{"samplers", json::array()}, {"channels", json::array()}});
  std::vector<json> nodes(kMany, {{"mesh", 0}, {"rotation", {0, 0, 0, 0}}});
  std::vector<int> roots(kMany);
  for (int i = 0; i < kMany; ++i) roots[static_cast<std::size_t>(i)] = i;
  root_["nodes"] = nodes;
  root_["scenes"][0]["nodes"] = roots;
  const auto scene = read();
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_THAT(scene->objects, SizeIs(kMany));
  EXPECT_THAT(scene->warnings, SizeIs(101));
  EXPECT_THAT(scene->warnings, Contains("/nodes/99 has a rotation of length 0: not rotated"));
  EXPECT_THAT(scene->warnings.back(), HasSubstr("more than 100 warnings"));
}

TEST_F(GltfFile, AnimationsWithoutANameAreNumbered) {
  indexedSquare();
  const int times = floats({0, 1}, "SCALAR", 1), values = floats({0, 0, 0, 1, 1, 1}, "VEC3", 3);
  root_["animations"] = std::vector<json>(
      2, {{"samplers", {{{"input", times}, {"output", values}}}},
          {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "scale"}}}}}}});
  const auto scene = read();
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->animations.at(1).name, "animations/1");
}

}  // namespace
}  // namespace lucerna::scene
