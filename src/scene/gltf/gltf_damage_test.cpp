// A file that uses every feature is damaged at random, thousands of times: whatever is wrong, the
// reader answers with a message or with a scene whose indices are sound.
#include <gmock/gmock.h>

#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>

#include "core/test_folder.hpp"
#include "scene/check_scene.hpp"
#include "scene/gltf/gltf_reader.hpp"

namespace lucerna::scene {
namespace {

using nlohmann::json;

// One triangle (positions 0 to 35, indices 36 to 41, two key times 44 to 51, three times two
// values 52 to 75, joints 76 to 87, their weights 88 to 135), and everything else that the reader
// knows.
json exampleScene() {
  return json::parse(R"({
    "asset": {"version": "2.0"}, "scene": 0,
    "extensionsUsed": ["KHR_lights_punctual", "EXT_mesh_gpu_instancing"],
    "extensionsRequired": ["KHR_lights_punctual"],
    "extensions": {"KHR_lights_punctual": {"lights": [
      {"type": "spot", "color": [1, 1, 1], "intensity": 2, "range": 3,
       "spot": {"innerConeAngle": 0.1, "outerConeAngle": 0.2}}]}},
    "scenes": [{"name": "s", "nodes": [0]}],
    "nodes": [
      {"children": [1, 2], "name": "root", "translation": [1, 2, 3], "rotation": [0, 0, 0, 1]},
      {"mesh": 0, "matrix": [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1], "camera": 0, "skin": 0,
       "extensions": {"KHR_lights_punctual": {"light": 0}}},
      {"mesh": 0, "scale": [1, 1, 1], "camera": 1, "weights": [0.5],
       "extensions": {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 4}}}}],
    "cameras": [
      {"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1, "zfar": 10}},
      {"type": "orthographic", "orthographic": {"xmag": 1, "ymag": 1, "znear": 0, "zfar": 10}}],
    "meshes": [{"name": "m", "primitives": [
      {"attributes": {"POSITION": 0, "NORMAL": 0, "COLOR_0": 0, "JOINTS_0": 5, "WEIGHTS_0": 6},
       "indices": 1, "material": 0, "targets": [{"POSITION": 0, "NORMAL": 4}]},
      {"attributes": {"POSITION": 4}, "mode": 5, "targets": [{"POSITION": 0}]}],
      "weights": [1]}],
    "skins": [{"joints": [0, 2], "inverseBindMatrices": 7}],
    "materials": [{"alphaMode": "MASK", "alphaCutoff": 0.5, "doubleSided": true,
      "emissiveFactor": [1, 1, 1], "normalTexture": {"index": 0, "scale": 1},
      "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 2}},
      "pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1, 1], "metallicFactor": 0,
        "baseColorTexture": {"index": 0, "texCoord": 1, "extensions":
          {"KHR_texture_transform": {"offset": [0, 0], "scale": [1, 1], "rotation": 1}}}}}],
    "textures": [{"source": 0, "sampler": 0}],
    "samplers": [{"wrapS": 33071, "wrapT": 10497, "magFilter": 9728}],
    "images": [{"bufferView": 0, "mimeType": "image/png"}],
    "animations": [{"samplers": [{"input": 2, "output": 3, "interpolation": "LINEAR"},
                                 {"input": 2, "output": 2}],
      "channels": [{"sampler": 0, "target": {"node": 1, "path": "translation"}},
                   {"sampler": 1, "target": {"node": 2, "path": "weights"}}]}],
    "accessors": [
      {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
      {"bufferView": 0, "byteOffset": 36, "componentType": 5123, "count": 3, "type": "SCALAR"},
      {"bufferView": 0, "byteOffset": 44, "componentType": 5126, "count": 2, "type": "SCALAR"},
      {"bufferView": 0, "byteOffset": 52, "componentType": 5126, "count": 2, "type": "VEC3"},
      {"componentType": 5126, "count": 3, "type": "VEC3", "sparse": {"count": 1,
        "indices": {"bufferView": 0, "byteOffset": 36, "componentType": 5121},
        "values": {"bufferView": 0, "byteOffset": 52}}},
      {"bufferView": 0, "byteOffset": 76, "componentType": 5121, "count": 3, "type": "VEC4"},
      {"bufferView": 0, "byteOffset": 88, "componentType": 5126, "count": 3, "type": "VEC4"},
      {"bufferView": 0, "byteOffset": 8, "componentType": 5126, "count": 2, "type": "MAT4"}],
    "bufferViews": [{"buffer": 0, "byteLength": 136}],
    "buffers": [{"byteLength": 136}]})");
}

std::string exampleBytes() {
  std::string bytes(136, '\0');
  const float positions[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const std::uint16_t indices[3] = {0, 1, 2};
  const float times[2] = {0, 1};
  const float values[6] = {0, 0, 0, 1, 2, 3};
  const std::uint8_t joints[12] = {0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0};
  const float weights[12] = {0.5f, 0.5f, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};
  std::memcpy(&bytes[76], joints, 12);
  std::memcpy(&bytes[88], weights, 48);
  std::memcpy(&bytes[0], positions, 36);
  std::memcpy(&bytes[36], indices, 6);
  std::memcpy(&bytes[44], times, 8);
  std::memcpy(&bytes[52], values, 24);
  return bytes;
}

void append32(std::string& file, std::size_t value) {
  for (int byte = 0; byte < 4; ++byte) file += static_cast<char>((value >> (8 * byte)) & 0xFF);
}

std::string glb(std::string text, const std::string& bytes) {
  text.resize((text.size() + 3) / 4 * 4, ' ');
  std::string file = "glTF";
  append32(file, 2);
  append32(file, 12 + 8 + text.size() + 8 + bytes.size());
  append32(file, text.size());
  file += "JSON" + text;
  append32(file, bytes.size());
  file += std::string("BIN\0", 4) + bytes;
  return file;
}

using Random = std::mt19937;
std::size_t below(Random& random, std::size_t count) {
  return random() % count;
}

// Every value of the document, the document itself left out.
void collect(json& value, std::vector<json*>& all) {
  for (json& child : value) {
    all.push_back(&child);
    if (child.is_structured()) collect(child, all);
  }
}

void damage(json& document, Random& random) {
  static const std::vector<json> kOdd = {nullptr,
                                         true,
                                         -1,
                                         0,
                                         1,
                                         2,
                                         3,
                                         76,
                                         4294967295,
                                         1e300,
                                         0.25,
                                         "x",
                                         "TRANSLATION",
                                         json::array(),
                                         json::array({0}),
                                         json::object(),
                                         5126,
                                         5121,
                                         100,
                                         1e-30,
                                         {{"bufferView", 0}}};
  std::vector<json*> all;
  collect(document, all);
  json& victim = *all[below(random, all.size())];
  if (victim.is_array() && !victim.empty() && random() % 2 == 0) {
    victim.push_back(victim[below(random, victim.size())]);
  } else if (victim.is_object() && !victim.empty() && random() % 2 == 0) {
    victim.erase(std::next(victim.begin(), static_cast<long>(below(random, victim.size()))));
  } else if (random() % 4 == 0) {
    victim = json(*all[below(random, all.size())]);  // something from elsewhere
  } else {
    victim = kOdd[below(random, kOdd.size())];
  }
}

class GltfDamage : public testing::Test {
 protected:
  // True if it was drawn.
  bool check(const std::string& file) {
    const std::filesystem::path path = folder_ / "damaged.glb";
    std::ofstream(path, std::ios::binary) << file;
    auto scene = readGltf(path);
    if (!scene) {
      EXPECT_EQ(scene.error().kind, ErrorKind::Input);
      EXPECT_THAT(scene.error().message, testing::HasSubstr("damaged.glb: "));
      return false;
    }
    const Status sound = checkScene(*scene, scene->textures.size());
    EXPECT_TRUE(sound) << (sound ? "" : sound.error().message);
    for (const Texture& texture : scene->textures) EXPECT_NE(texture.image, nullptr);
    complete(*scene);
    animate(*scene, 0.5f);
    return true;
  }

  TestFolder folder_;
};

TEST_F(GltfDamage, TheUndamagedFileIsDrawn) {
  EXPECT_TRUE(check(glb(exampleScene().dump(), exampleBytes())));
}

TEST_F(GltfDamage, WrongValuesAnywhereAreRefusedOrRepaired) {
  Random random(1);
  int drawn = 0;
  constexpr int kRounds = 3000;
  for (int round = 0; round < kRounds; ++round) {
    SCOPED_TRACE(round);
    json document = exampleScene();
    for (std::size_t count = 1 + below(random, 3); count > 0; --count) damage(document, random);
    drawn += check(glb(document.dump(), exampleBytes()));
    if (HasFailure()) return;
  }
  // Both happen often, or the damage is of the wrong kind.
  EXPECT_GT(drawn, kRounds / 20);
  EXPECT_LT(drawn, kRounds * 19 / 20);
}

TEST_F(GltfDamage, WrongBytesAnywhereAreRefusedOrRepaired) {
  Random random(2);
  const std::string whole = glb(exampleScene().dump(), exampleBytes());
  for (int round = 0; round < 2000; ++round) {
    SCOPED_TRACE(round);
    std::string file = whole;
    if (random() % 4 == 0) file.resize(below(random, file.size()));
    for (std::size_t count = below(random, 8); count > 0 && !file.empty(); --count) {
      file[below(random, file.size())] = static_cast<char>(random());
    }
    check(file);
    if (HasFailure()) return;
  }
}

}  // namespace
}  // namespace lucerna::scene
