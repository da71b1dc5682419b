// Features of glTF beyond plain meshes, a small file for each.
#include <gmock/gmock.h>

#include "scene/gltf/gltf_file.hpp"

namespace lucerna::scene {
namespace {

using nlohmann::json;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

// Primitive modes.

TEST_F(GltfFile, StripsAndFansBecomeTriangleListsThatFaceForward) {
  json& primitive = square();
  primitive["indices"] = accessor<std::uint8_t>({0, 1, 3, 2}, 5121, "SCALAR", 1);
  primitive["attributes"]["NORMAL"] = squareNormals();
  primitive["mode"] = 5;
  auto scene = read();
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_THAT(scene->meshes[0].indices, ElementsAre(0, 1, 3, 1, 2, 3));

  root_["meshes"][0]["primitives"][0]["mode"] = 6;
  root_["meshes"][0]["primitives"][0].erase("indices");
  scene = read();
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_THAT(scene->meshes[0].indices, ElementsAre(1, 2, 0, 2, 3, 0));
}

TEST_F(GltfFile, LinesAndPointsBecomeListsAndAreNoTriangles) {
  json& primitive = square();
  const auto meshOf = [&](int mode) {
    root_["meshes"][0]["primitives"][0]["mode"] = mode;
    auto scene = read();
    EXPECT_TRUE(scene) << scene.error().message;
    EXPECT_THAT(scene->warnings, IsEmpty());
    EXPECT_EQ(scene->triangleCount(), 0u);
    EXPECT_EQ(scene->boundsW().max, vec3(1, 1, 0));
    return scene->meshes.at(0);
  };
  EXPECT_THAT(meshOf(0).points, ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(meshOf(1).lines, ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(meshOf(2).lines, ElementsAre(0, 1, 1, 2, 2, 3, 3, 0));
  EXPECT_THAT(meshOf(3).lines, ElementsAre(0, 1, 1, 2, 2, 3));
  EXPECT_THAT(meshOf(3).normals, IsEmpty());  // so that they are unlit
  primitive = root_["meshes"][0]["primitives"][0];
  primitive["indices"] = accessor<std::uint8_t>({2, 0, 3}, 5121, "SCALAR", 1);
  EXPECT_THAT(meshOf(0).points, ElementsAre(2, 0, 3));
  EXPECT_THAT(meshOf(3).lines, ElementsAre(2, 0, 0, 3));
}

TEST_F(GltfFile, ElementsThatAreNotCompleteAreLeftOut) {
  square()["mode"] = 1;
  root_["meshes"][0]["primitives"][0]["indices"] =
      accessor<std::uint8_t>({0, 1, 2}, 5121, "SCALAR", 1);
  auto scene = read();
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_THAT(scene->meshes.at(0).lines, ElementsAre(0, 1));
  EXPECT_THAT(scene->warnings, Contains(HasSubstr("3 indices, not a multiple of 2")));

  root_["meshes"][0]["primitives"][0]["indices"] = accessor<std::uint8_t>({1}, 5121, "SCALAR", 1);
  for (const int mode : {1, 2, 3, 4, 5, 6}) {
    root_["meshes"][0]["primitives"][0]["mode"] = mode;
    scene = read();
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_THAT(scene->meshes, IsEmpty()) << mode;
  }
  root_["meshes"][0]["primitives"][0]["mode"] = 7;
  expectRefused({"/meshes/0/primitives/0/mode: found 7, wanted an integer from 0 to 6"});
}

TEST_F(GltfFile, LinesAtInfinityAreDropped) {
  json& primitive = square();
  primitive["attributes"]["POSITION"] =
      floats({0, 0, 0, 1, 0, 0, INFINITY, 1, 0, 0, 1, 0}, "VEC3", 3);
  primitive["mode"] = 1;
  const auto scene = read();
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_THAT(scene->meshes[0].lines, ElementsAre(0, 1));
  EXPECT_EQ(scene->boundsW().max, vec3(1, 0, 0));
  EXPECT_THAT(scene->warnings, Contains(HasSubstr("1 of 2 lines dropped")));
}

// Data.

TEST_F(GltfFile, NormalizedAndInterleavedDataAreConverted) {
  // Corners of 16 bytes: position as floats, texture coordinate as normalized unsigned shorts.
  json& primitive = root_["meshes"][0]["primitives"][0];
  struct Corner {
    float position[3];
    std::uint16_t uv[2];
  };
  const Corner corners[3] = {{{0, 0, 0}, {0, 0}}, {{1, 0, 0}, {65535, 0}}, {{0, 1, 0}, {0, 32768}}};
  buffer_.assign(reinterpret_cast<const char*>(corners), sizeof(corners));
  root_["bufferViews"][0] = {{"buffer", 0}, {"byteLength", 48}, {"byteStride", 16}};
  root_["accessors"] = {
      {{"bufferView", 0}, {"componentType", 5126}, {"count", 3}, {"type", "VEC3"}},
      {{"bufferView", 0},
       {"byteOffset", 12},
       {"componentType", 5123},
       {"count", 3},
       {"type", "VEC2"},
       {"normalized", true}}};
  primitive["attributes"] = {{"POSITION", 0}, {"TEXCOORD_0", 1}};
  primitive["attributes"]["COLOR_0"] =
      accessor<std::uint16_t>({65535, 0, 32768, 0, 0, 0, 0, 0, 65535}, 5123, "VEC3", 3, true);
  const auto scene = read();
  ASSERT_TRUE(scene) << scene.error().message;
  const Mesh& mesh = scene->meshes[0];
  EXPECT_EQ(mesh.positions[2], vec3(0, 1, 0));
  EXPECT_EQ(mesh.texCoords[0][1], vec2(1, 0));
  EXPECT_NEAR(mesh.texCoords[0][2].y, 0.5f, 1e-5f);
  EXPECT_EQ(mesh.colors[0], u8vec4(255, 0, 128, 255));
}

TEST_F(GltfFile, QuantizedMeshesAreScaledByTheirNode) {
  json& primitive = root_["meshes"][0]["primitives"][0];
  root_["extensionsUsed"] = root_["extensionsRequired"] = {"KHR_mesh_quantization"};
  primitive["attributes"]["POSITION"] =
      accessor<std::int16_t>({0, 0, -8, 16, 0, 0, 0, 16, 8, 16, 16, 0}, 5122, "VEC3", 3);
  primitive["attributes"]["NORMAL"] =
      accessor<std::int8_t>({0, 0, 127, 0, 0, 127, 0, 0, 127, 0, 0, -128}, 5120, "VEC3", 3, true);
  primitive["attributes"]["TEXCOORD_0"] =
      accessor<std::uint8_t>({0, 2, 4, 8, 16, 32, 64, 128}, 5121, "VEC2", 2);
  primitive["mode"] = 5;  // a strip
  root_["nodes"][0]["scale"] = {0.125, 0.125, 0.125};
  const auto scene = read();
  ASSERT_TRUE(scene) << scene.error().message;
  const Mesh& mesh = scene->meshes.at(0);
  EXPECT_EQ(mesh.positions[0], vec3(0, 0, -8));
  EXPECT_EQ(scene->boundsW().max, vec3(2, 2, 1));
  EXPECT_EQ(mesh.normals[0], vec3(0, 0, 1));
  EXPECT_EQ(mesh.normals[3], vec3(0, 0, -1));
  EXPECT_EQ(mesh.texCoords[0][3], vec2(64, 128));  // not normalized: as they are
}

TEST_F(GltfFile, SparseAccessorsReplaceElements) {
  json& primitive = indexedSquare();
  const int at = accessor<std::uint8_t>({2}, 5121, "SCALAR", 1);
  const int with = floats({7, 8, 9}, "VEC3", 3);
  const json accessors = root_["accessors"];
  root_["accessors"][primitive["attributes"]["POSITION"].get<int>()]["sparse"] = {
      {"count", 1},
      {"indices", {{"bufferView", accessors[at]["bufferView"]}, {"componentType", 5121}}},
      {"values", {{"bufferView", accessors[with]["bufferView"]}}}};
  auto scene = read();
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->meshes[0].positions[2], vec3(7, 8, 9));
  EXPECT_EQ(scene->meshes[0].positions[1], vec3(1, 0, 0));
}

// A sparse accessor without a bufferView is zeros with changes, wherever accessors may stand.
TEST_F(GltfFile, SparseAccessorsMayStandAnywhere) {
  json& primitive = square();
  const auto sparse = [&](json accessor, const std::vector<std::uint16_t>& at, int values) {
    accessor["sparse"] = {{"count", at.size()},
                          {"indices", {{"bufferView", view(at)}, {"componentType", 5123}}},
                          {"values", {{"bufferView", values}}}};
    root_["accessors"].push_back(accessor);
    return root_["accessors"].size() - 1;
  };
  primitive["indices"] = sparse({{"componentType", 5121}, {"count", 6}, {"type", "SCALAR"}},
                                {1, 2, 4, 5}, view<std::uint8_t>({1, 2, 2, 3}));
  primitive["attributes"]["COLOR_0"] =
      sparse({{"componentType", 5121}, {"count", 4}, {"type", "VEC4"}, {"normalized", true}}, {3},
             view<std::uint8_t>({10, 20, 30, 40}));
  primitive["attributes"]["NORMAL"] = squareNormals();
  const int output = static_cast<int>(sparse(
      {{"componentType", 5126}, {"count", 2}, {"type", "VEC3"}}, {1}, view<float>({7, 8, 9})));
  root_["animations"][0] = {
      {"samplers", {{{"input", floats({0, 1}, "SCALAR", 1)}, {"output", output}}}},
      {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}};
  const auto scene = read();
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_THAT(scene->meshes[0].indices, ElementsAre(0, 1, 2, 0, 2, 3));
  EXPECT_EQ(scene->meshes[0].colors[3], u8vec4(10, 20, 30, 40));
  EXPECT_EQ(scene->meshes[0].colors[0], u8vec4(0));
  EXPECT_EQ(scene->animations.at(0).channels.at(0).values.at(1), vec4(7, 8, 9, 1));
}

TEST_F(GltfFile, RefusesSparseIndicesBeyondTheAccessor) {
  json& primitive = indexedSquare();
  root_["accessors"][primitive["attributes"]["POSITION"].get<int>()]["sparse"] = {
      {"count", 1},
      {"indices", {{"bufferView", view<std::uint8_t>({4})}, {"componentType", 5121}}},
      {"values", {{"bufferView", view<float>({7, 8, 9})}}}};
  expectRefused({"/accessors/0/sparse/indices: found index 4", "below the accessor's count of 4"});
  root_["accessors"][0]["sparse"]["count"] = 5;
  expectRefused({"/accessors/0/sparse/count: found 5, wanted an integer from 1 to 4"});
  root_["accessors"][0]["sparse"]["count"] = 2;
  expectRefused({"/accessors/0/sparse/indices: found 2 elements at byte 0, 2 bytes in all"});
}

// Materials.

TEST_F(GltfFile, UnlitMaterialsKeepTheirColour) {
  indexedSquare()["material"] = 0;
  root_["extensionsRequired"] = {"KHR_materials_unlit"};
  root_["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] = {0.5, 0.25, 1, 0.5};
  root_["materials"][0]["extensions"]["KHR_materials_unlit"] = json::object();
  const auto scene = read();
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->materials[0].model, MaterialModel::Unlit);
  EXPECT_EQ(scene->materials[0].albedo, vec4(0.5f, 0.25f, 1, 0.5f));
  EXPECT_EQ(scene->materials[0].emissive, vec3(0.f));
}

TEST_F(GltfFile, SpecularGlossinessGoesBeforeItsFallback) {
  indexedSquare()["material"] = 0;
  root_["images"][0]["uri"] = "missing.png";
  root_["textures"][0]["source"] = 0;
  root_["extensionsRequired"] = {"KHR_materials_pbrSpecularGlossiness"};
  root_["materials"][0] = json::parse(R"({
    "pbrMetallicRoughness": {"baseColorFactor": [0, 0, 0, 1]},
    "extensions": {"KHR_materials_pbrSpecularGlossiness": {
      "diffuseFactor": [0.1, 0.2, 0.3, 0.4], "specularFactor": [0.5, 0.6, 0.7],
      "glossinessFactor": 0.75, "diffuseTexture": {"index": 0, "texCoord": 1}}}})");
  auto scene = read();
  ASSERT_TRUE(scene) << scene.error().message;
  const Material& m = scene->materials[0];
  EXPECT_EQ(m.model, MaterialModel::SpecularGlossiness);
  EXPECT_EQ(m.albedo, vec4(0.1f, 0.2f, 0.3f, 0.4f));
  EXPECT_EQ(m.specular, vec3(0.5f, 0.6f, 0.7f));
  EXPECT_EQ(m.roughness, 0.25f);
  EXPECT_EQ(m.albedoTexture.texCoord, 1);

  root_["materials"][0]["extensions"]["KHR_materials_pbrSpecularGlossiness"] = json::object();
  scene = read();
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->materials[0].albedo, vec4(1.f));
  EXPECT_EQ(scene->materials[0].specular, vec3(1.f));
  EXPECT_EQ(scene->materials[0].roughness, 0.f);
}

TEST_F(GltfFile, Ktx2TexturesAreRefusedOrReplacedByTheirFallback) {
  indexedSquare()["material"] = 0;
  root_["images"] = {{{"uri", "a.png"}}, {{"uri", "a.ktx2"}}};
  root_["textures"][0] = {{"source", 0}, {"extensions", {{"KHR_texture_basisu", {{"source", 1}}}}}};
  root_["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["index"] = 0;
  root_["extensionsUsed"] = {"KHR_texture_basisu"};
  auto scene = read();
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->textures.at(0).name, "a.png");
  EXPECT_THAT(scene->warnings, Not(Contains(HasSubstr("a.ktx2"))));

  root_["textures"][0].erase("source");
  scene = read();
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_THAT(scene->warnings, Contains(HasSubstr("needs the extension KHR_texture_basisu")));

  root_["extensionsRequired"] = {"KHR_texture_basisu"};
  expectRefused({"/extensionsRequired/0: found \"KHR_texture_basisu\"",
                 "KTX2 files, which are not decoded", "with PNG or JPEG textures"});
}

}  // namespace
}  // namespace lucerna::scene
