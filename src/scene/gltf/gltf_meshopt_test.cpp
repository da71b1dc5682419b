// Meshes packed by meshoptimizer, made here with its encoders.
#include <gmock/gmock.h>
#include <meshoptimizer.h>

#include <cmath>
#include <random>

#include "scene/gltf/gltf_file.hpp"

namespace lucerna::scene {
namespace {

using nlohmann::json;
using testing::IsEmpty;

class MeshoptFile : public GltfFile {
 protected:
  // A view of `count` elements over packed bytes; its own buffer has no data.
  int packedView(const std::vector<unsigned char>& bytes, std::size_t count, std::size_t stride,
                 const char* mode, const char* filter = "NONE") {
    root_["extensionsUsed"] =
        root_["extensionsRequired"] = {"EXT_meshopt_compression", "KHR_mesh_quantization"};
    json& fallback = root_["buffers"][1];
    const std::size_t offset = fallback.is_null() ? 0 : fallback["byteLength"].get<std::size_t>();
    fallback["extensions"]["EXT_meshopt_compression"]["fallback"] = true;
    fallback["byteLength"] = offset + count * stride;
    const int source = view(bytes);
    json packed = root_["bufferViews"][source];
    packed.update({{"count", count}, {"byteStride", stride}, {"mode", mode}, {"filter", filter}});
    root_["bufferViews"][source] = {{"buffer", 1},
                                    {"byteOffset", offset},
                                    {"byteLength", count * stride},
                                    {"extensions", {{"EXT_meshopt_compression", packed}}}};
    return source;
  }
  template <typename T>
  int packedVertices(const std::vector<T>& values, std::size_t stride,
                     const char* filter = "NONE") {
    const std::size_t count = values.size() * sizeof(T) / stride;
    std::vector<unsigned char> bytes(meshopt_encodeVertexBufferBound(count, stride));
    bytes.resize(
        meshopt_encodeVertexBuffer(bytes.data(), bytes.size(), values.data(), count, stride));
    return packedView(bytes, count, stride, "ATTRIBUTES", filter);
  }
  int accessorOn(int bufferView, int componentType, const char* type, int count,
                 bool normalized = false) {
    const int made = described(componentType, type, count, normalized);
    root_["accessors"][made]["bufferView"] = bufferView;
    return made;
  }
  // The square with packed positions and packed indices.
  json& packedSquare(bool sequence = false) {
    json& primitive = root_["meshes"][0]["primitives"][0];
    primitive["attributes"]["POSITION"] = accessorOn(
        packedVertices<float>({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, 12), 5126, "VEC3", 4);
    primitive["attributes"]["NORMAL"] = squareNormals();
    const std::vector<std::uint32_t> indices{0, 1, 2, 0, 2, 3};
    std::vector<unsigned char> bytes(256);
    bytes.resize(sequence ? meshopt_encodeIndexSequence(bytes.data(), 256, indices.data(), 6)
                          : meshopt_encodeIndexBuffer(bytes.data(), 256, indices.data(), 6));
    primitive["indices"] =
        accessorOn(packedView(bytes, 6, 2, sequence ? "INDICES" : "TRIANGLES"), 5123, "SCALAR", 6);
    return primitive;
  }
  json& packedOf(int accessor) {
    return root_["bufferViews"][root_["accessors"][accessor]["bufferView"].get<int>()]["extensions"]
                ["EXT_meshopt_compression"];
  }
};

TEST_F(MeshoptFile, VerticesAndIndicesAreUnpacked) {
  for (const bool sequence : {false, true}) {
    packedSquare(sequence);
    const auto scene = read();
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_THAT(scene->warnings, IsEmpty());
    EXPECT_EQ(scene->triangleCount(), 2u);
    EXPECT_EQ(scene->meshes[0].bounds.max, vec3(1, 1, 0));
    EXPECT_EQ(scene->meshes[0].positions[2], vec3(1, 1, 0));
  }
}

TEST_F(MeshoptFile, FiltersAreUndone) {
  json& primitive = packedSquare();
  const float half = std::sqrt(0.5f);
  const std::vector<float> normals{0, 0, 1, 0, half, 0, half, 0, -1, 0, 0, 0, 0, -half, half, 0};
  std::vector<std::int8_t> octahedral(16);
  meshopt_encodeFilterOct(octahedral.data(), 4, 4, 8, normals.data());
  primitive["attributes"]["NORMAL"] =
      accessorOn(packedVertices(octahedral, 4, "OCTAHEDRAL"), 5120, "VEC3", 4, true);
  root_["bufferViews"].back()["byteStride"] = 4;
  std::vector<std::uint32_t> exponential(8);
  const std::vector<float> uv{0, 0.25f, 1, -3, 0.5f, 100, 7, 0};
  meshopt_encodeFilterExp(exponential.data(), 4, 8, 16, uv.data());
  primitive["attributes"]["TEXCOORD_0"] =
      accessorOn(packedVertices(exponential, 8, "EXPONENTIAL"), 5126, "VEC2", 4);
  const std::vector<float> turns{0, 0, 0, 1, 0, half, 0, half};
  std::vector<std::int16_t> quaternions(8);
  meshopt_encodeFilterQuat(quaternions.data(), 2, 8, 16, turns.data());
  const int output =
      accessorOn(packedVertices(quaternions, 8, "QUATERNION"), 5122, "VEC4", 2, true);
  root_["animations"][0] = {
      {"samplers", {{{"input", floats({0, 1}, "SCALAR", 1)}, {"output", output}}}},
      {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "rotation"}}}}}}};
  const auto scene = read();
  ASSERT_TRUE(scene) << scene.error().message;
  const Mesh& mesh = scene->meshes[0];
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_LT(glm::distance(mesh.normals[i],
                            vec3(normals[4 * i], normals[4 * i + 1], normals[4 * i + 2])),
              0.02f);
    EXPECT_NEAR(mesh.texCoords[0][i].x, uv[2 * i], 0.01f);
    EXPECT_NEAR(mesh.texCoords[0][i].y, uv[2 * i + 1], 0.01f);
  }
  const vec4 turn = scene->animations.at(0).channels.at(0).values.at(1);
  EXPECT_LT(glm::distance(turn, vec4(0, half, 0, half)), 1e-3f);
}

TEST_F(MeshoptFile, RefusesWhatDoesNotFit) {
  json& primitive = packedSquare();
  const int position = primitive["attributes"]["POSITION"], indices = primitive["indices"];
  const json good = packedOf(position), goodIndices = packedOf(indices);
  const auto with = [&](const char* key, const json& value, const std::vector<std::string>& words) {
    packedOf(position)[key] = value;
    expectRefused(words);
    packedOf(position) = good;
  };
  with("count", 5, {"/count: found 5 elements of 12 bytes", "48 bytes of the bufferView"});
  with("count", 4000000000u, {"found 4000000000 elements"});
  with("byteStride", 8, {"data that meshoptimizer cannot unpack"});
  with("byteStride", 10, {"/byteStride: found 10, wanted a multiple of 4"});
  with("byteStride", 260, {"/byteStride: found 260"});
  with("mode", "POINTS", {"/mode: found \"POINTS\""});
  with("filter", "COLOR", {"/filter: found \"COLOR\""});
  with("filter", "OCTAHEDRAL", {"4 or 8 for the filter OCTAHEDRAL"});
  with("filter", "QUATERNION", {"8 for the filter QUATERNION"});
  with("byteLength", 4000, {"/byteLength: found 4000 at byte"});
  with("buffer", 2, {"/buffer: found 2"});
  with("buffer", 1, {"packed data inside the 0 bytes"});
  packedOf(indices)["filter"] = "EXPONENTIAL";
  expectRefused({"only ATTRIBUTES have filters"});
  packedOf(indices) = goodIndices;
  packedOf(indices)["count"] = 5;
  expectRefused({"/count: found 5, wanted a multiple of 3"});
  packedOf(indices) = goodIndices;
  packedOf(indices)["byteStride"] = 3;
  expectRefused({"2 or 4, the size of an index"});
}

TEST_F(MeshoptFile, DamagedDataIsRefusedOrDrawn) {
  packedSquare();
  const std::string whole = buffer_;
  std::mt19937 random(6);
  int refused = 0;
  constexpr int kRounds = 500;
  for (int round = 0; round < kRounds; ++round) {
    SCOPED_TRACE(round);
    buffer_ = whole;
    for (int i = 0; i < 2; ++i) buffer_[random() % buffer_.size()] = static_cast<char>(random());
    const auto scene = read();
    refused += !scene;
    if (!scene) continue;
    for (const Mesh& mesh : scene->meshes)
      for (const std::uint32_t index : mesh.indices) ASSERT_LT(index, mesh.positions.size());
  }
  EXPECT_GT(refused, kRounds / 20);
}

TEST_F(MeshoptFile, TheNewerExtensionIsRefusedWithTheWayOut) {
  indexedSquare();
  root_["extensionsRequired"] = {"KHR_meshopt_compression"};
  expectRefused({"KHR_meshopt_compression", "with EXT_meshopt_compression, which is read"});
}

}  // namespace
}  // namespace lucerna::scene
