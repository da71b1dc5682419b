#include "scene/load.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <set>

#include "core/text.hpp"
#include "scene/append.hpp"
#include "scene/builtin/builtin.hpp"
#include "scene/gltf/gltf_reader.hpp"
#include "scene/import/import.hpp"
#include "scene/load_parts.hpp"
#include "scene/scene_json.hpp"
#include "scene/texture_store.hpp"

namespace lucerna::scene {
namespace {

namespace fs = std::filesystem;

std::string lowerExtension(const fs::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

Status checkReadable(const fs::path& path) {
  std::error_code code;
  const fs::file_status status = fs::status(path, code);
  if (status.type() == fs::file_type::not_found)
    return error(ErrorKind::Input, "{}: no such file; wanted a scene file or builtin:NAME ({})",
                 path.string(), join(builtinNames()));
  if (status.type() == fs::file_type::directory)
    return error(ErrorKind::Input, "{}: is a folder; name the scene file inside it", path.string());
  return {};
}

// The clips of a file are alternatives (walk, run, ...): together they would mix their poses.
void playFirstClip(Scene& scene) {
  for (std::size_t i = 1; i < scene.animations.size(); ++i) scene.animations[i].playing = false;
}

// A scene with meshes and textures of its own.
Result<Scene> readWhole(const std::string& pathOrName) {
  if (pathOrName.starts_with("builtin:")) return makeBuiltin(pathOrName);
  const std::string extension = lowerExtension(pathOrName);
  if (extension == ".gltf" || extension == ".glb") return readGltf(pathOrName);
  static constexpr std::array kImported{".obj", ".ac", ".acc", ".dae", ".fbx", ".ply", ".3ds"};
  if (std::find(kImported.begin(), kImported.end(), extension) != kImported.end())
    return importScene(pathOrName);
  return error(ErrorKind::Input,
               "{}: found the extension '{}'; wanted one of .gltf .glb .obj .ac .acc .dae .fbx "
               ".ply .3ds, or .json for a scene JSON",
               pathOrName, extension);
}

// Counts its pictures to those of the scenes before.
Status countTextures(const Scene& scene, const std::string& name, SceneLoad& load) {
  std::set<const Image*> known{checkerboard().get()};
  std::uint64_t bytes = 0;
  const auto count = [&](const std::shared_ptr<const Image>& image) {
    if (known.insert(image.get()).second) bytes += image->bytes().size();
  };
  for (const Texture& texture : scene.textures) {
    count(texture.image);
    for (const auto& face : texture.faces) count(face);
  }
  if (bytes > kMaxTextureBytes - load.textureBytes)
    return error(ErrorKind::Input,
                 "{}: its textures take {}, and with them those of all scenes more than {}; make "
                 "them smaller, or include less",
                 name, bytesText(bytes), bytesText(kMaxTextureBytes));
  load.textureBytes += bytes;
  return {};
}

// What the scene JSON beside a file says.
Status readBeside(Scene& scene, fs::path path, SceneLoad& load) {
  path.replace_extension(".lucerna.json");
  std::error_code code;
  return fs::exists(path, code) ? addSceneJson(scene, path, load) : Status();
}

}  // namespace

Result<Scene> readScene(const std::string& pathOrName, SceneLoad& load) {
  const bool isFile = !pathOrName.starts_with("builtin:");
  if (isFile) LUCERNA_TRY_VOID(checkReadable(pathOrName));
  Scene scene;
  scene.name = fs::path(pathOrName).filename().string();
  if (isFile && lowerExtension(pathOrName) == ".json") {
    LUCERNA_TRY_VOID(addSceneJson(scene, pathOrName, load));
  } else {
    LUCERNA_TRY(whole, readWhole(pathOrName));
    if (whole.name.empty()) whole.name = std::move(scene.name);
    scene = std::move(whole);
    addDefaultMaterial(scene);
    LUCERNA_TRY_VOID(countTextures(scene, pathOrName, load));
    moveShared(scene, load.meshes, load.textures);
    if (isFile) {
      playFirstClip(scene);
      LUCERNA_TRY_VOID(readBeside(scene, pathOrName, load));
    }
  }
  return scene;
}

Result<Scene> loadScene(const std::string& pathOrName) {
  SceneLoad load;
  LUCERNA_TRY(scene, readScene(pathOrName, load));
  scene.meshes = std::move(load.meshes);
  scene.textures = std::move(load.textures);
  complete(scene);
  return scene;
}

}  // namespace lucerna::scene
