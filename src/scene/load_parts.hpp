// How loadScene() and the scene JSON call each other: a scene JSON includes scenes, and a scene
// file brings the scene JSON beside it.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "scene/outside_files.hpp"
#include "scene/scene.hpp"

namespace lucerna::scene {

// One call of loadScene(). However often a file is included, it is read once: the scenes that come
// of it share its meshes and textures, which stand here meanwhile, their own lists being empty.
struct SceneLoad {
  std::vector<Mesh> meshes;
  std::vector<Texture> textures;
  std::uint64_t textureBytes = 0;           // of their pictures, at most kMaxTextureBytes
  std::vector<std::filesystem::path> open;  // JSONs being read, outermost first
  // What was included, by path or built-in name. Its warnings have been passed on.
  std::map<std::string, Result<Scene>> included;
  std::uint64_t repeatedBytes = 0;  // of scenes that were included again
  // Refuse: scenes to include must stand in `included`, built-in ones too.
  OutsideFiles outsideFiles = OutsideFiles::Read;
};

// Grey, named "default", for objects without a material. A part of complete() that scene JSONs may
// change the outcome of.
void addDefaultMaterial(Scene& scene);

// loadScene() without complete(); meshes and textures are in `load`.
Result<Scene> readScene(const std::string& pathOrName, SceneLoad& load);

}  // namespace lucerna::scene
