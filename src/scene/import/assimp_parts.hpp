// The parts of readWithAssimp(): each turns one kind of assimp's data into ours.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "scene/import/imported_scene.hpp"

struct aiScene;

namespace lucerna::scene {

// What the kinds of files mean by the same data.
struct FileConventions {
  bool ac3d = false;
  bool obj = false;
};

// Our material of each of assimp's; kNone for assimp's stand-in in files without materials.
std::vector<std::uint32_t> convertMaterials(const aiScene& source, const FileConventions& file,
                                            ImportedScene& result);

using NodesByName = std::map<std::string, std::uint32_t>;

// Lights and cameras get nodes of their own below the node of their name.
void convertLights(const aiScene& source, const NodesByName& nodes, Scene& scene);
void convertCameras(const aiScene& source, const NodesByName& nodes, Scene& scene);
void convertAnimations(const aiScene& source, const NodesByName& nodes, Scene& scene);

}  // namespace lucerna::scene
