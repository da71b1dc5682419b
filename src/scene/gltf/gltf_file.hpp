// A small glTF file that a test writes: JSON plus one buffer.
#pragma once

#include <gmock/gmock.h>

#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/test_folder.hpp"
#include "scene/gltf/gltf_reader.hpp"

namespace lucerna::scene {

class GltfFile : public testing::Test {
 protected:
  GltfFile() {
    root_["asset"]["version"] = "2.0";
    root_["scene"] = 0;
    root_["scenes"][0]["nodes"] = {0};
    root_["nodes"][0]["mesh"] = 0;
  }

  // Appends a buffer view over new data and returns its index.
  template <typename T>
  int view(const std::vector<T>& values) {
    while (buffer_.size() % 4 != 0) buffer_.push_back('\0');
    const std::size_t offset = buffer_.size();
    buffer_.resize(offset + values.size() * sizeof(T));
    std::memcpy(buffer_.data() + offset, values.data(), values.size() * sizeof(T));
    root_["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", values.size() * sizeof(T)}});
    return static_cast<int>(root_["bufferViews"].size()) - 1;
  }
  // Appends an accessor over new data and returns its index.
  template <typename T>
  int accessor(const std::vector<T>& values, int componentType, const char* type, int components,
               bool normalized = false) {
    nlohmann::json made = {{"bufferView", view(values)},
                           {"componentType", componentType},
                           {"count", values.size() / static_cast<std::size_t>(components)},
                           {"type", type}};
    if (normalized) made["normalized"] = true;
    root_["accessors"].push_back(made);
    return static_cast<int>(root_["accessors"].size()) - 1;
  }
  // An accessor without data of its own.
  int described(int componentType, const char* type, int count, bool normalized = false) {
    root_["accessors"].push_back({{"componentType", componentType},
                                  {"type", type},
                                  {"count", count},
                                  {"normalized", normalized}});
    return static_cast<int>(root_["accessors"].size()) - 1;
  }
  int floats(const std::vector<float>& values, const char* type, int components) {
    return accessor(values, 5126, type, components);
  }
  // Four equal normals, so that the square keeps its vertices.
  int squareNormals() { return floats({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3", 3); }
  // A unit square of four corners in the first primitive.
  nlohmann::json& square() {
    nlohmann::json& primitive = root_["meshes"][0]["primitives"][0];
    primitive["attributes"]["POSITION"] = floats({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, "VEC3", 3);
    return primitive;
  }
  nlohmann::json& indexedSquare() {
    nlohmann::json& primitive = square();
    primitive["indices"] = accessor<std::uint16_t>({0, 1, 2, 0, 2, 3}, 5123, "SCALAR", 1);
    return primitive;
  }

  Result<Scene> read() {
    if (!buffer_.empty()) {
      root_["buffers"][0]["byteLength"] = buffer_.size();
      root_["buffers"][0]["uri"] = "a%20b.bin";  // percent-encoded
      std::ofstream(folder_ / "a b.bin", std::ios::binary) << buffer_;
    }
    return readText(root_.dump());
  }
  Result<Scene> readText(const std::string& text, const char* name = "test.gltf") {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    auto scene = readGltf(folder_ / name);
    if (scene) updateTransforms(*scene);
    return scene;
  }
  // Reads and expects a refusal whose message contains all words.
  void expectRefused(const std::vector<std::string>& words) {
    const auto scene = read();
    ASSERT_FALSE(scene) << "was read";
    EXPECT_EQ(scene.error().kind, ErrorKind::Input);
    for (const auto& word : words) EXPECT_THAT(scene.error().message, testing::HasSubstr(word));
  }

  nlohmann::json root_;
  std::string buffer_;
  TestFolder folder_;
};

}  // namespace lucerna::scene
