// The sections of a scene JSON. Faults go to the JsonFaults of the value; what is wrong is left as
// it was, and pictures that cannot be had are checkerboards.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "core/json_value.hpp"
#include "scene/load_parts.hpp"
#include "scene/scene.hpp"
#include "scene/texture_store.hpp"

namespace lucerna::scene {

// Pictures that the JSON names, added to the textures of `load`, each once; load() then reads them
// together. Paths are relative to the folder.
class JsonPictures {
 public:
  JsonPictures(std::filesystem::path folder, SceneLoad& load)
      : folder_(std::move(folder)), load_(load) {}

  // Index in those textures, or kNone after a fault.
  std::uint32_t add(const JsonValue& file, Wrap wrap = Wrap::ClampToEdge);
  std::uint32_t addCube(const JsonValue& sixFiles);
  // What "file" or "faces" names, or else the material's `texture`; with "wrap", which is Repeat of
  // a "file" unless given. kNone after a fault.
  std::uint32_t read(const JsonValue& from, std::uint32_t texture = kNone);
  bool isCube(std::uint32_t texture) const { return load_.textures[texture].isCube(); }
  // Reports and returns false where no other file may be read.
  bool mayRead(const JsonValue& file) const;
  const std::filesystem::path& folder() const { return folder_; }
  void load();

 private:
  // A texture without its image, or without its six faces.
  struct Wanted {
    std::uint32_t texture;
    std::vector<JsonValue> files;
    std::vector<std::size_t> tickets;
  };
  std::uint32_t want(Texture texture, const std::vector<JsonValue>& files,
                     const std::vector<std::string>& names);
  std::uint32_t addTexture(Texture texture);
  std::uint32_t wrapped(std::uint32_t texture, Wrap wrap);

  std::filesystem::path folder_;
  SceneLoad& load_;
  TextureStore store_;
  std::vector<Wanted> wanted_;
  std::map<std::string, std::uint32_t> known_;
};

// A texture of a material. The keys were checked.
void readSlot(const JsonValue& from, JsonPictures& pictures, TextureSlot& slot);

void readMaterials(const JsonValue& materials, JsonPictures& pictures, Scene& scene);
void readLights(const JsonValue& lights, Scene& scene);
void readLightSettings(const JsonValue& settings, Scene& scene);
void readCameras(const JsonValue& cameras, Scene& scene);
void readBake(const JsonValue& from, BakeHints& bake);
void readBackground(const JsonValue& from, JsonPictures& pictures, Background& background);

}  // namespace lucerna::scene
