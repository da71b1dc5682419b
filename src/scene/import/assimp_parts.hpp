// The parts of readWithAssimp(): each turns one kind of assimp's data into ours.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "scene/import/imported_scene.hpp"
#include "scene/import/lights_ini.hpp"

struct aiScene;

namespace lucerna::scene {

// What the kinds of files mean by the same data.
struct FileConventions {
  bool ac3d = false;
  bool obj = false;
  const LightsIni* lights = nullptr;  // given: edges are the lights that this describes
};

// Our material of each of assimp's; kNone for assimp's stand-in in files without materials.
std::vector<std::uint32_t> convertMaterials(const aiScene& source, const FileConventions& file,
                                            ImportedScene& result);

using NodesByName = std::map<std::string, std::uint32_t>;

// A node at `position` that looks along `direction`, below the node of that name if there is one.
std::uint32_t addLookingNode(Scene& scene, const NodesByName& nodes, const std::string& name,
                             vec3 position, vec3 direction, vec3 up);
// These files' intensity 1 gives a white surface brightness 1, so pi of ours. A colour brighter
// than 1 becomes intensity.
void setRelativeStrength(vec3 color, Light& light);

// Lights and cameras get nodes of their own below the node of their name.
void convertLights(const aiScene& source, const NodesByName& nodes, Scene& scene);
// Each edge of an OBJ's objects one light from its first point towards its second, as the file of
// the lights says, and what that says about baking.
void convertEdges(const aiScene& source, const NodesByName& nodes, const LightsIni& ini,
                  Scene& scene);
void convertCameras(const aiScene& source, const NodesByName& nodes, Scene& scene);
void convertAnimations(const aiScene& source, const NodesByName& nodes, Scene& scene);

}  // namespace lucerna::scene
