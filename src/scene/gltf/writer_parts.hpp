// The parts of the glTF writer. What they write is numbered in the order of its first use.
#pragma once

#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/file.hpp"
#include "scene/gltf/gltf_writer.hpp"

namespace lucerna::scene::gltf {

using Json = nlohmann::ordered_json;

// What glTF cannot say, each kind once with how often it was met.
class Notes {
 public:
  void add(const std::string& what);
  std::vector<std::string> sentences() const;

 private:
  std::vector<std::pair<std::string, std::size_t>> counts_;
};

struct Output {
  const Scene& scene;
  const GltfSettings& settings;
  Json root = Json::object();
  Bytes binary{};
  std::set<std::string> extensions{};
  Notes notes{};

  // Appends to one of the root's arrays; its index.
  std::size_t append(const char* array, Json value);
  // The extension's object in `owner`.
  Json& extend(Json& owner, const char* extension);
};

Json jsonOf(vec2 v);
Json jsonOf(vec3 v);
Json jsonOf(vec4 v);

// Accessors over new data, each with a buffer view of its own.
std::size_t addStream(Output& out, std::span<const vec2> values);
std::size_t addStream(Output& out, std::span<const vec3> values);
std::size_t addStream(Output& out, std::span<const vec4> values);
std::size_t addStream(Output& out, std::span<const u8vec4> values);  // unorm
std::size_t addPositions(Output& out, std::span<const vec3> values);
std::size_t addZeros(Output& out, std::size_t count);  // vec2; takes no bytes
std::size_t addIndices(Output& out, std::span<const std::uint32_t> values, std::size_t vertices);

class TextureWriter {
 public:
  struct Picture {
    std::string file;
    std::shared_ptr<const Image> image;
    bool color = true;  // floats become sRGB, else they stay linear
  };

  explicit TextureWriter(Output& out) : out_(out) {}

  // color: whether it is read as sRGB. Index of the glTF texture.
  std::size_t texture(std::uint32_t index, bool color);
  std::size_t lightmap(std::size_t map);
  const std::vector<Picture>& pictures() const { return pictures_; }

 private:
  std::size_t image(const Texture& texture, bool color);
  std::size_t sampler(int magnify, int minify, Wrap s, Wrap t);

  Output& out_;
  std::vector<Picture> pictures_;
  std::map<std::pair<std::uint32_t, bool>, std::size_t> textures_;
  std::map<std::pair<const Image*, bool>, std::size_t> images_;
  std::map<std::string, std::size_t> samplers_;
  std::map<std::size_t, std::size_t> lightmaps_;
};

// ErrorKind::Usage: glTF has no way of naming such a file as a lightmap.
Status checkLightmaps(const GltfSettings& settings);
Result<std::vector<GltfReport::File>> writePictures(
    const std::filesystem::path& folder, std::span<const TextureWriter::Picture> pictures);

// How many sets of texture coordinates the material's textures need.
int coordinateSets(const Material& material);
// The set that baked light is read with: the first that they leave free, but 0.
int lightmapSet(const Material& material);

class MaterialWriter {
 public:
  MaterialWriter(Output& out, TextureWriter& textures) : out_(out), textures_(textures) {}

  // map: that the surface lies in, -1: none. MOZ_lightmap sits on the material, so each map needs
  // a copy of it.
  std::size_t material(std::uint32_t index, int map);

 private:
  Json write(const Material& material);
  void writeBase(const Material& material, Json& json);
  void writeSpecularGlossiness(const Material& material, Json& json);
  void writeEmission(const Material& material, Json& json);
  std::optional<Json> slot(const TextureSlot& slot, bool color);
  void noteWhatIsLost(const Material& material);

  Output& out_;
  TextureWriter& textures_;
  std::map<std::pair<std::uint32_t, int>, std::size_t> materials_;
  std::set<std::uint32_t> noted_;  // once for all copies
};

class MeshWriter {
 public:
  MeshWriter(Output& out, MaterialWriter& materials)
      : out_(out), materials_(materials), streams_(out.scene.meshes.size()) {}

  // Of the objects of one node; the same meshes with the same materials are one glTF mesh.
  std::size_t mesh(std::span<const Object> objects);

 private:
  // The triangles of one map, or all that the mesh is made of.
  struct Part {
    int map = -1;
    std::size_t indices = 0;  // accessor
  };
  struct Streams {
    std::vector<Part> parts;
    std::map<std::string, std::size_t> accessors;  // by the attribute that the mesh has it for
  };

  Streams& streamsOf(std::uint32_t mesh);
  void addParts(const Mesh& mesh, Streams& streams);
  void addPrimitives(const Object& object, Json& primitives);
  Json attributes(const Object& object, const Part& part);
  std::size_t zeros(std::size_t count);

  Output& out_;
  MaterialWriter& materials_;
  std::vector<Streams> streams_;  // as Scene::meshes
  std::map<std::size_t, std::size_t> zeros_;
  std::map<std::vector<std::pair<std::uint32_t, std::uint32_t>>, std::size_t> meshes_;
};

// Nodes, and the cameras and lights on them.
void writeNodes(Output& out, MeshWriter& meshes);

}  // namespace lucerna::scene::gltf
