// Small glTF files written by the tests, one for each rule of the format that is easy to get wrong.
#include <gmock/gmock.h>

#include "scene/gltf/gltf_file.hpp"

namespace lucerna::scene {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;

TEST_F(GltfFile, SeveralNodesShareAMeshAndItsEqualPrimitives) {
  json& primitive = indexedSquare();
  json copy = primitive;
  copy["material"] = 0;
  root_["materials"][0]["name"] = "red";
  root_["meshes"][0]["primitives"].push_back(copy);
  root_["nodes"] = {{{"mesh", 0}, {"children", {1}}}, {{"mesh", 0}, {"translation", {1, 2, 3}}}};
  const auto scene = read();
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->meshes.size(), 1u);
  ASSERT_EQ(scene->objects.size(), 4u);
  EXPECT_EQ(scene->materials.size(), 2u);  // red, and the default of the first primitive
  EXPECT_EQ(scene->objects[1].material, 0u);
  EXPECT_EQ(scene->objects[0].material, 1u);
  EXPECT_EQ(scene->nodes[1].parent, 0u);
  EXPECT_EQ(scene->objects[3].boundsW.min, vec3(1, 2, 3));
}

TEST_F(GltfFile, MatricesBecomeTransformsOrStayIfTheyShear) {
  indexedSquare();
  root_["scenes"][0]["nodes"] = {0, 1};
  // Columns: x to -2y, y to 3x, z to z: a quarter turn with a mirror, and scale 2, 3, 1.
  root_["nodes"][0]["matrix"] = {0, -2, 0, 0, -3, 0, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1};
  root_["nodes"][1] = {{"mesh", 0}, {"matrix", {1, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}};
  const auto scene = read();
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_FALSE(scene->nodes[0].matrix);
  const vec4 corner = scene->nodes[0].worldFromNode * vec4(1, 1, 1, 1);
  EXPECT_LT(glm::distance(corner, vec4(2, 4, 8, 1)), 1e-5f);
  ASSERT_TRUE(scene->nodes[1].matrix);
  EXPECT_EQ(scene->nodes[1].worldFromNode[1], vec4(1, 1, 0, 0));
}

TEST_F(GltfFile, FewUsedVerticesAreGathered) {
  json& primitive = root_["meshes"][0]["primitives"][0];
  std::vector<float> positions(300);
  for (std::size_t i = 0; i < 300; ++i) positions[i] = static_cast<float>(i);
  primitive["attributes"]["POSITION"] = floats(positions, "VEC3", 3);
  primitive["indices"] = accessor<std::uint32_t>({90, 5, 40}, 5125, "SCALAR", 1);
  const auto scene = read();
  ASSERT_TRUE(scene) << scene.error().message;
  const Mesh& mesh = scene->meshes[0];
  ASSERT_EQ(mesh.positions.size(), 3u);
  EXPECT_EQ(mesh.positions[mesh.indices[0]].x, 270.f);
  EXPECT_EQ(mesh.positions[mesh.indices[1]].x, 15.f);
  EXPECT_EQ(mesh.positions[mesh.indices[2]].x, 120.f);
}

TEST_F(GltfFile, MaterialsKeepEveryField) {
  json& primitive = indexedSquare();
  primitive["material"] = 0;
  root_["images"][0]["uri"] = "missing.png";
  root_["samplers"][0] = {{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}};
  root_["textures"][0] = {{"source", 0}, {"sampler", 0}};
  root_["materials"][0] = json::parse(R"({
    "name": "m", "alphaMode": "MASK", "alphaCutoff": 0.25, "doubleSided": true,
    "emissiveFactor": [1, 0.5, 0],
    "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 4}},
    "emissiveTexture": {"index": 0, "texCoord": 1},
    "normalTexture": {"index": 0, "scale": 2},
    "occlusionTexture": {"index": 0, "strength": 0.5},
    "pbrMetallicRoughness": {
      "baseColorFactor": [0.1, 0.2, 0.3, 0.4], "metallicFactor": 0.5, "roughnessFactor": 0.6,
      "baseColorTexture": {"index": 0, "extensions": {"KHR_texture_transform":
        {"offset": [0.5, 0.25], "scale": [2, 3], "rotation": 1.5, "texCoord": 1}}}}})");
  const auto scene = read();
  ASSERT_TRUE(scene) << scene.error().message;
  const Material& m = scene->materials[0];
  EXPECT_EQ(m.alphaMode, AlphaMode::Mask);
  EXPECT_EQ(m.alphaCutoff, 0.25f);
  EXPECT_TRUE(m.doubleSided);
  EXPECT_EQ(m.emissive, vec3(4, 2, 0));
  EXPECT_EQ(m.emissiveTexture.texCoord, 1);
  EXPECT_EQ(m.normalScale, 2.f);
  EXPECT_EQ(m.occlusionStrength, 0.5f);
  EXPECT_EQ(m.albedo, vec4(0.1f, 0.2f, 0.3f, 0.4f));
  EXPECT_EQ(m.metallic, 0.5f);
  EXPECT_EQ(m.roughness, 0.6f);
  EXPECT_EQ(m.albedoTexture.texCoord, 1);
  EXPECT_EQ(m.albedoTexture.offset, vec2(0.5f, 0.25f));
  EXPECT_EQ(m.albedoTexture.scale, vec2(2, 3));
  EXPECT_EQ(m.albedoTexture.rotation, 1.5f);
  ASSERT_EQ(scene->textures.size(), 1u);  // one glTF texture in four slots
  EXPECT_EQ(scene->textures[0].wrapS, Wrap::ClampToEdge);
  EXPECT_EQ(scene->textures[0].wrapT, Wrap::MirroredRepeat);
  EXPECT_TRUE(scene->textures[0].nearest);
  ASSERT_NE(scene->textures[0].image, nullptr);
  EXPECT_EQ(scene->textures[0].image->width(), 64);  // the checkerboard
  EXPECT_TRUE(m.albedoTexture.used());
  EXPECT_FALSE(m.normalTexture.used());  // data: without, rather than the checkerboard
  EXPECT_FALSE(m.occlusionTexture.used());
  EXPECT_THAT(scene->warnings, Contains(HasSubstr("texture missing.png is replaced")));
}

TEST_F(GltfFile, LightsAndCamerasStandAtTheirNodes) {
  indexedSquare();
  root_["extensionsRequired"] = {"KHR_lights_punctual"};
  root_["extensions"]["KHR_lights_punctual"]["lights"] = json::parse(R"([
    {"type": "spot", "color": [1, 0.5, 0.25], "intensity": 20, "range": 8,
     "spot": {"innerConeAngle": 0.2, "outerConeAngle": 0.4}},
    {"type": "directional", "intensity": 3}])");
  root_["cameras"] = json::parse(R"([
    {"type": "perspective", "perspective": {"yfov": 0.7, "znear": 0.1, "aspectRatio": 1.5}},
    {"type": "orthographic", "orthographic": {"xmag": 4, "ymag": 2, "znear": 0, "zfar": 9}}])");
  root_["scenes"][0]["nodes"] = {0, 1, 2};
  root_["nodes"][1] = {{"camera", 0}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}};
  root_["nodes"][2] = {{"camera", 1}, {"extensions", {{"KHR_lights_punctual", {{"light", 1}}}}}};
  const auto scene = read();
  ASSERT_TRUE(scene) << scene.error().message;
  ASSERT_EQ(scene->lights.size(), 2u);
  const Light& spot = scene->lights[0];
  EXPECT_EQ(spot.kind, LightKind::Spot);
  EXPECT_EQ(spot.color, vec3(1, 0.5f, 0.25f));
  EXPECT_EQ(spot.intensity, 20.f);
  EXPECT_EQ(spot.range, 8.f);
  EXPECT_EQ(spot.innerCone, 0.2f);
  EXPECT_EQ(spot.outerCone, 0.4f);
  EXPECT_EQ(spot.node, 1u);
  EXPECT_EQ(scene->lights[1].kind, LightKind::Directional);
  ASSERT_EQ(scene->cameras.size(), 2u);
  EXPECT_EQ(scene->cameras[0].fovY, 0.7f);
  EXPECT_TRUE(std::isinf(scene->cameras[0].far));
  EXPECT_EQ(scene->cameras[1].height, 4.f);
  EXPECT_EQ(scene->cameras[1].aspect, 2.f);
}

TEST_F(GltfFile, CamerasSeeAwayFromThemselves) {
  indexedSquare();
  root_["nodes"][1] = {{"camera", 0}};
  root_["scenes"][0]["nodes"] = {0, 1};
  for (const char* camera :
       {R"({"type": "perspective", "perspective": {"yfov": 0.7, "znear": 5, "zfar": 1}})",
        R"({"type": "orthographic",
            "orthographic": {"xmag": 4, "ymag": 2, "znear": 5, "zfar": 5}})"}) {
    root_["cameras"][0] = json::parse(camera);
    expectRefused({"/zfar", "wanted a number above znear, which is 5"});
  }
}

TEST_F(GltfFile, AnimationsKeepKeysAndInterpolation) {
  indexedSquare();
  const int times = floats({0, 1}, "SCALAR", 1);
  const int places = floats(std::vector<float>(18, 2.f), "VEC3", 3);
  const int turns = accessor<std::int16_t>({0, 0, 0, 32767, 0, 32767, 0, 0}, 5122, "VEC4", 4, true);
  root_["animations"][0] = {
      {"samplers",
       {{{"input", times}, {"output", places}, {"interpolation", "CUBICSPLINE"}},
        {{"input", times}, {"output", turns}, {"interpolation", "STEP"}}}},
      {"channels",
       {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}},
        {{"sampler", 1}, {"target", {{"node", 0}, {"path", "rotation"}}}},
        {{"sampler", 1}, {"target", {{"node", 0}, {"path", "weights"}}}}}}};
  auto scene = read();
  ASSERT_TRUE(scene) << scene.error().message;
  const auto& channels = scene->animations.at(0).channels;
  ASSERT_EQ(channels.size(), 2u);
  EXPECT_EQ(channels[0].interpolation, Interpolation::CubicSpline);
  EXPECT_EQ(channels[0].values.size(), 6u);
  EXPECT_EQ(channels[1].interpolation, Interpolation::Step);
  EXPECT_EQ(channels[1].values[1], vec4(0, 1, 0, 0));
  EXPECT_THAT(scene->warnings, Contains(HasSubstr("node 0, which has no morph targets")));

  root_["animations"][0]["samplers"][1]["interpolation"] = "CUBICSPLINE";
  expectRefused({"/accessors/4", "2 values for 2 times", "3 a time"});
}

TEST_F(GltfFile, KeysAtTheSameTimeStayAJump) {
  indexedSquare();
  const int times = floats({0, 1, 1, 1, 2}, "SCALAR", 1);
  const int places = floats(std::vector<float>(15, 0.f), "VEC3", 3);
  root_["animations"][0] = {
      {"samplers", {{{"input", times}, {"output", places}}}},
      {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "scale"}}}}}}};
  const auto scene = read();
  ASSERT_TRUE(scene) << scene.error().message;
  const auto& read = scene->animations.at(0).channels.at(0).times;
  for (std::size_t i = 1; i < read.size(); ++i) EXPECT_LT(read[i - 1], read[i]);
  EXPECT_NEAR(read[3], 1.f, 1e-6f);
  EXPECT_THAT(scene->warnings, Contains(HasSubstr("keys at the same time")));
}

TEST_F(GltfFile, InstancesBecomeObjects) {
  indexedSquare();
  const int places = floats({0, 0, 0, 5, 0, 0, 10, 0, 0}, "VEC3", 3);
  root_["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
  root_["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] = places;
  const auto scene = read();
  ASSERT_TRUE(scene) << scene.error().message;
  ASSERT_EQ(scene->objects.size(), 3u);
  EXPECT_EQ(scene->objects[2].boundsW.min.x, 10.f);
  EXPECT_EQ(scene->meshes.size(), 1u);
}

TEST_F(GltfFile, InstancesAreScaledThenTurnedThenMovedBelowTheirNode) {
  indexedSquare();
  root_["nodes"][0]["translation"] = {0, 0, 7};
  json& attributes = root_["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
  attributes["TRANSLATION"] = floats({0, 0, 0, 5, 0, 0}, "VEC3", 3);
  attributes["SCALE"] = floats({1, 1, 1, 2, 3, 1}, "VEC3", 3);
  // Not turned; a half turn about z.
  attributes["ROTATION"] =
      accessor<std::int8_t>({0, 0, 0, 127, 0, 0, 127, 0}, 5120, "VEC4", 4, true);
  root_["extensionsUsed"] = {"EXT_mesh_gpu_instancing"};
  const auto scene = read();
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_THAT(scene->warnings, testing::IsEmpty());
  ASSERT_EQ(scene->objects.size(), 2u);
  EXPECT_EQ(scene->objects[0].boundsW.max, vec3(1, 1, 7));
  const Aabb& turned = scene->objects[1].boundsW;
  EXPECT_LT(glm::distance(turned.min, vec3(3, -3, 7)), 1e-5f);
  EXPECT_LT(glm::distance(turned.max, vec3(5, 0, 7)), 1e-5f);
  root_["accessors"][attributes["SCALE"].get<int>()]["count"] = 1;
  expectRefused({"/nodes/0/extensions/EXT_mesh_gpu_instancing/attributes/SCALE",
                 "found an accessor with count 1", "2, as in the other attributes"});
}

TEST_F(GltfFile, ZeroNormalsTakeTheDirectionOfTheirTriangles) {
  json& primitive = indexedSquare();
  primitive["attributes"]["NORMAL"] = floats({0, 0, 0, 2, 0, 0, NAN, 0, 0, 0, 1, 0}, "VEC3", 3);
  const auto scene = read();
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_THAT(scene->meshes[0].normals,
              testing::ElementsAre(vec3(0, 0, 1), vec3(1, 0, 0), vec3(0, 0, 1), vec3(0, 1, 0)));
}

TEST_F(GltfFile, WithoutNormalsTrianglesAreFlatAndTangentsIgnored) {
  json& primitive = root_["meshes"][0]["primitives"][0];
  // Two triangles folded along their common edge.
  primitive["attributes"]["POSITION"] = floats({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, "VEC3", 3);
  primitive["attributes"]["TANGENT"] =
      floats({1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1}, "VEC4", 4);
  primitive["attributes"]["TEXCOORD_0"] = floats({0, 0, 1, 0, 0, 1, 2, 2}, "VEC2", 2);
  primitive["indices"] = accessor<std::uint16_t>({0, 1, 2, 0, 3, 1}, 5123, "SCALAR", 1);
  const auto scene = read();
  ASSERT_TRUE(scene) << scene.error().message;
  const Mesh& mesh = scene->meshes[0];
  const vec3 z(0, 0, 1), y(0, 1, 0);
  EXPECT_THAT(mesh.normals, testing::ElementsAre(z, z, z, y, y, y));
  EXPECT_THAT(mesh.indices, testing::ElementsAre(0, 1, 2, 3, 4, 5));
  EXPECT_EQ(mesh.positions[4], vec3(0, 0, 1));
  EXPECT_EQ(mesh.texCoords[0][4], vec2(2, 2));
  EXPECT_THAT(mesh.tangents, testing::IsEmpty());
}

TEST_F(GltfFile, TrianglesAtInfinityAreDropped) {
  json& primitive = indexedSquare();
  primitive["attributes"]["POSITION"] =
      floats({0, 0, 0, INFINITY, 0, 0, 1, 1, 0, 0, 1, 0}, "VEC3", 3);
  primitive["attributes"]["NORMAL"] = squareNormals();
  const auto scene = read();
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_THAT(scene->meshes[0].indices, testing::ElementsAre(0, 2, 3));
  EXPECT_EQ(scene->boundsW().max, vec3(1, 1, 0));
  EXPECT_THAT(scene->warnings, Contains(HasSubstr("1 of 2 triangles dropped")));
}

// What must be refused, with the place in the file.

TEST_F(GltfFile, RefusesIndicesBeyondTheVertices) {
  square()["indices"] = accessor<std::uint16_t>({0, 1, 4}, 5123, "SCALAR", 1);
  expectRefused({"/meshes/0/primitives/0/indices", "found index 4 at element 2", "below 4"});
}

TEST_F(GltfFile, RefusesAttributesOfDifferentLength) {
  indexedSquare()["attributes"]["NORMAL"] = floats({0, 0, 1}, "VEC3", 3);
  expectRefused({"/meshes/0/primitives/0/attributes/NORMAL", "count 1", "wanted 4"});
}

TEST_F(GltfFile, RefusesAccessorsBeyondTheirView) {
  indexedSquare();
  root_["accessors"][0]["count"] = 4000000000u;
  expectRefused({"/accessors/0", "4000000000 elements", "48 bytes"});
}

TEST_F(GltfFile, RefusesBuffersLargerThanTheirFile) {
  indexedSquare();
  ASSERT_TRUE(read());
  root_["buffers"][0]["byteLength"] = 4000000000u;
  const auto scene = readText(root_.dump());
  ASSERT_FALSE(scene);
  EXPECT_THAT(scene.error().message, HasSubstr("/buffers/0/byteLength: found 4000000000, but"));
}

TEST_F(GltfFile, BesideASymbolicLinkIsWhereFilesAreLookedFor) {
  indexedSquare();
  ASSERT_TRUE(read());
  std::filesystem::create_directory(folder_ / "links");
  const std::filesystem::path link = folder_ / "links/link.gltf", target = folder_ / "test.gltf";
  std::filesystem::create_symlink(target, link);
  const auto scene = readGltf(link);
  ASSERT_FALSE(scene);
  EXPECT_THAT(scene.error().message,
              AllOf(HasSubstr("found no file " + (folder_ / "links/a b.bin").string()),
                    HasSubstr("put the file beside the symbolic link " + link.string() +
                              ", or name what that leads to: " +
                              std::filesystem::canonical(target).string())));
  std::filesystem::copy(folder_ / "a b.bin", folder_ / "links/a b.bin");
  EXPECT_TRUE(readGltf(link));
  std::filesystem::remove(folder_ / "links/a b.bin");
  std::filesystem::remove(link);
  std::filesystem::copy(target, link);
  EXPECT_THAT(readGltf(link).error().message, HasSubstr("put the file beside the scene"));
}

TEST_F(GltfFile, BuffersOfOneFileShareItsBytes) {
  indexedSquare();
  ASSERT_TRUE(read());
  root_["buffers"][1] = root_["buffers"][0];
  root_["bufferViews"][1]["buffer"] = 1;  // the indices
  const auto scene = readText(root_.dump());
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->triangleCount(), 2u);
}

TEST_F(GltfFile, RefusesHugeAccessorsOfZeros) {
  root_["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = 0;
  root_["accessors"][0] = {{"componentType", 5126}, {"count", 4000000000u}, {"type", "VEC3"}};
  expectRefused({"found data that expands to"});
}

TEST_F(GltfFile, RefusesTwoParentsAndCycles) {
  indexedSquare();
  root_["nodes"] = {{{"children", {2}}}, {{"children", {2}}}, {{"mesh", 0}}};
  expectRefused({"/nodes/1/children/0", "child of node 0 already"});
  root_["nodes"] = {{{"mesh", 0}}, {{"children", {2}}}, {{"children", {1}}}};
  expectRefused({"/nodes/1/children", "cycle"});
}

TEST_F(GltfFile, RefusesUnknownRequiredExtensions) {
  indexedSquare();
  root_["extensionsRequired"] = {"KHR_xmp_json_ld"};
  expectRefused({"/extensionsRequired/0", "KHR_xmp_json_ld", "export the file again"});
  root_.erase("extensionsRequired");
  root_["extensionsUsed"] = {"KHR_xmp_json_ld"};
  const auto scene = read();
  ASSERT_TRUE(scene);
  EXPECT_THAT(scene->warnings, Contains(HasSubstr("KHR_xmp_json_ld is not read")));
}

TEST_F(GltfFile, RefusesDeepNesting) {
  const std::string deep(100000, '[');
  const auto scene = readText("{\"asset\":{\"version\":\"2.0\",\"extras\":" + deep);
  ASSERT_FALSE(scene);
  EXPECT_THAT(scene.error().message, HasSubstr("more than 64 nested"));
}

TEST_F(GltfFile, BracketsInsideStringsAreNoNesting) {
  root_.erase("scene");
  root_.erase("scenes");
  root_.erase("nodes");
  root_["asset"]["generator"] = std::string(1000, '[') + "\"\\";
  EXPECT_TRUE(read());
}

TEST_F(GltfFile, RefusesWrongTypesByPlace) {
  indexedSquare();
  root_["nodes"][0]["translation"] = {1, "two", 3};
  expectRefused({"/nodes/0/translation/1: found \"two\", wanted a number"});
  root_["nodes"][0]["translation"] = {1, 2};
  expectRefused({"/nodes/0/translation: found an array of 2, wanted an array of 3 numbers"});
}

TEST_F(GltfFile, RefusesBrokenJsonByLine) {
  const auto scene = readText("{\"asset\":\n{\"version\" \"2.0\"}}");
  ASSERT_FALSE(scene);
  EXPECT_THAT(scene.error().message, HasSubstr("line 2"));
}

}  // namespace
}  // namespace lucerna::scene
