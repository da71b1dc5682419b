// For tests: what glTF 2.0 demands of a file with one buffer beside it, as far as a writer may get
// it wrong.
#pragma once

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "core/file.hpp"

namespace lucerna::scene {

class GltfStructure {
 public:
  // One sentence a fault.
  static std::vector<std::string> faultsOf(const std::filesystem::path& file) {
    GltfStructure check(file);
    check.checkBuffers();
    check.checkAccessors();
    check.checkMeshes();
    check.checkTextures();
    check.checkMaterials();
    check.checkNodes();
    check.checkExtensions();
    return check.faults_;
  }

 private:
  using Json = nlohmann::json;

  explicit GltfStructure(const std::filesystem::path& file) : folder_(file.parent_path()) {
    const Result<std::string> text = readText(file);
    root_ = text ? Json::parse(*text) : Json::object();
    expect(root_.value("/asset/version"_json_pointer, "") == "2.0", "no asset of version 2.0");
    for (const auto& [key, value] : root_.items())
      if (value.is_array()) expect(!value.empty(), key + " is empty");
  }

  using Text = std::string;
  void expect(bool good, const Text& fault) {
    if (!good) faults_.push_back(fault);
  }
  std::size_t count(const char* array) const {
    return root_.contains(array) ? root_[array].size() : 0;
  }
  const Json& list(const char* array) const {
    static const Json none = Json::array();
    return root_.contains(array) ? root_[array] : none;
  }
  void index(const Json& owner, const char* key, const char* array) {
    if (!owner.contains(key)) return;
    expect(owner[key].is_number_unsigned() && owner[key].get<std::size_t>() < count(array),
           Text(key) + " is no index of " + array);
  }

  void checkBuffers() {
    expect(count("buffers") == 1, "not one buffer");
    for (const Json& buffer : list("buffers")) {
      const Result<Bytes> bytes = readFile(folder_ / buffer["uri"].get<Text>());
      expect(bytes && bytes->size() == buffer["byteLength"], "the buffer has another length");
      if (bytes) buffer_ = *bytes;
    }
    std::size_t end = 0;
    for (const Json& view : list("bufferViews")) {
      index(view, "buffer", "buffers");
      expect(view["byteOffset"] >= end && view["byteOffset"].get<std::size_t>() % 4 == 0,
             "a view overlaps the one before it or is not aligned");
      expect(view["byteLength"] > 0, "a view is empty");
      end = view["byteOffset"].get<std::size_t>() + view["byteLength"].get<std::size_t>();
      expect(end <= buffer_.size(), "a view goes beyond the buffer");
    }
  }

  static std::size_t bytesOf(const Json& accessor) {
    const Text type = accessor["type"];
    const std::size_t components = type == "SCALAR" ? 1 : static_cast<std::size_t>(type[3] - '0');
    const int component = accessor["componentType"];
    return components * (component == 5121 ? 1u : component == 5123 ? 2u : 4u);
  }

  void checkAccessors() {
    std::set<std::size_t> viewed;
    for (const Json& accessor : list("accessors")) {
      expect(accessor["count"] > 0, "an accessor is empty");
      index(accessor, "bufferView", "bufferViews");
      if (!accessor.contains("bufferView")) continue;
      const std::size_t view = accessor["bufferView"];
      expect(viewed.insert(view).second, "a view without a stride has two accessors");
      expect(bytesOf(accessor) * accessor["count"].get<std::size_t>() ==
                 list("bufferViews")[view]["byteLength"].get<std::size_t>(),
             "an accessor is not as long as its view");
    }
    expect(viewed.size() == count("bufferViews"), "a view is not used");
  }

  const Json& viewOf(std::size_t accessor) const {
    const std::size_t view = list("accessors")[accessor]["bufferView"];
    return list("bufferViews")[view];
  }

  template <typename T>
  std::vector<T> read(std::size_t accessor) const {
    const Json& view = viewOf(accessor);
    std::vector<T> values(view["byteLength"].get<std::size_t>() / sizeof(T));
    std::memcpy(values.data(), buffer_.data() + view["byteOffset"].get<std::size_t>(),
                values.size() * sizeof(T));
    return values;
  }

  void checkPositions(std::size_t accessor) {
    const Json& json = list("accessors")[accessor];
    if (!checked_.insert(accessor).second) return;
    const std::vector<float> values = read<float>(accessor);
    for (std::size_t c = 0; c < 3; ++c) {
      float low = values[c], high = values[c];
      for (std::size_t i = c; i < values.size(); i += 3) {
        low = std::min(low, values[i]);
        high = std::max(high, values[i]);
      }
      expect(json.contains("min") && json["min"][c] == low && json["max"][c] == high,
             "the bounds of a POSITION are wrong");
    }
  }

  void checkIndices(std::size_t accessor, std::size_t vertices) {
    const Json& json = list("accessors")[accessor];
    std::size_t most = 0;
    if (json["componentType"] == 5123)
      for (const std::uint16_t i : read<std::uint16_t>(accessor))
        most = std::max<std::size_t>(most, i);
    else
      for (const std::uint32_t i : read<std::uint32_t>(accessor))
        most = std::max<std::size_t>(most, i);
    expect(most < vertices, "an index is beyond the vertices");
    expect(json["componentType"] != 5123 || most < 65535, "an index restarts the primitive");
    expect(target(accessor) == 34963, "indices have another target");
  }

  int target(std::size_t accessor) const { return viewOf(accessor)["target"]; }

  void checkMeshes() {
    for (const Json& mesh : list("meshes")) {
      expect(!mesh["primitives"].empty(), "a mesh is empty");
      for (const Json& primitive : mesh["primitives"]) checkPrimitive(primitive);
    }
    for (std::size_t i = 0; i < count("accessors"); ++i)
      expect(used_.contains(i), "accessor " + std::to_string(i) + " is not used");
  }

  void checkPrimitive(const Json& primitive) {
    const Json& attributes = primitive["attributes"];
    const Json& accessors = list("accessors");
    const std::size_t vertices = accessors[attributes["POSITION"].get<std::size_t>()]["count"];
    checkPositions(attributes["POSITION"]);
    int sets = 0;
    for (const auto& [name, accessor] : attributes.items()) {
      used_.insert(accessor.get<std::size_t>());
      expect(accessors[accessor.get<std::size_t>()]["count"] == vertices, name + " is not as long");
      if (accessors[accessor.get<std::size_t>()].contains("bufferView"))
        expect(target(accessor) == 34962, name + " has another target");
      sets += name.starts_with("TEXCOORD_") ? 1 : 0;
    }
    for (int set = 0; set < sets; ++set)
      expect(attributes.contains("TEXCOORD_" + std::to_string(set)), "a gap in the TEXCOORDs");
    used_.insert(primitive["indices"].get<std::size_t>());
    checkIndices(primitive["indices"], vertices);
    index(primitive, "material", "materials");
    if (primitive.contains("material"))
      checkSets(list("materials")[primitive["material"].get<std::size_t>()], sets);
  }

  // Each texture's coordinates are there.
  void checkSets(const Json& json, int sets) {
    if (json.is_object() && json.contains("index"))
      expect(json.value("texCoord", 0) < sets, "a texture has no coordinates");
    if (json.is_structured())
      for (const Json& child : json) checkSets(child, sets);
  }

  void checkTextures() {
    for (const Json& texture : list("textures")) {
      index(texture, "source", "images");
      index(texture, "sampler", "samplers");
      if (texture.contains("extensions"))
        for (const Json& extension : texture["extensions"]) index(extension, "source", "images");
      expect(texture.contains("source") || texture.contains("extensions"), "a texture is empty");
    }
    for (const Json& image : list("images"))
      expect(std::filesystem::exists(folder_ / image["uri"].get<Text>()), "an image is missing");
  }

  void checkTextureIndices(const Json& json) {
    if (json.is_object()) index(json, "index", "textures");
    if (json.is_structured())
      for (const Json& child : json) checkTextureIndices(child);
  }

  void checkMaterials() {
    for (const Json& material : list("materials")) {
      checkTextureIndices(material);
      for (const Json& c : material.value("emissiveFactor", Json::array()))
        expect(c >= 0 && c <= 1, "an emissiveFactor is beyond 1");
      const Json& pbr = material["pbrMetallicRoughness"];
      for (const Json& c : pbr["baseColorFactor"])
        expect(c >= 0 && c <= 1, "a baseColorFactor is beyond 1");
      for (const char* key : {"metallicFactor", "roughnessFactor"})
        expect(pbr[key] >= 0 && pbr[key] <= 1, Text(key) + " is beyond 1");
      expect(!material.contains("alphaCutoff") || material["alphaMode"] == "MASK",
             "an alphaCutoff without a mask");
    }
  }

  void checkNodes() {
    std::vector<int> parents(count("nodes"), 0);
    const auto take = [&](const Json& nodes) {
      expect(!nodes.empty(), "an empty list of nodes");
      for (const Json& node : nodes) {
        expect(node < count("nodes"), "no such node");
        ++parents[node.get<std::size_t>()];
      }
    };
    for (const Json& node : list("nodes")) {
      if (node.contains("children")) take(node["children"]);
      index(node, "mesh", "meshes");
      index(node, "camera", "cameras");
    }
    for (const Json& scene : list("scenes"))
      if (scene.contains("nodes")) take(scene["nodes"]);
    expect(std::ranges::all_of(parents, [](int n) { return n == 1; }),
           "a node is not once in the tree");
  }

  void collect(const Json& json, std::set<Text>& names) {
    if (json.is_object() && json.contains("extensions"))
      for (const auto& [name, value] : json["extensions"].items()) names.insert(name);
    if (json.is_structured())
      for (const Json& child : json) collect(child, names);
  }

  void checkExtensions() {
    std::set<Text> names;
    collect(root_, names);
    expect(root_.value("extensionsUsed", std::set<Text>()) == names,
           "extensionsUsed are not those that are used");
  }

  std::filesystem::path folder_;
  Json root_;
  Bytes buffer_;
  std::set<std::size_t> used_, checked_;
  std::vector<std::string> faults_;
};

}  // namespace lucerna::scene
