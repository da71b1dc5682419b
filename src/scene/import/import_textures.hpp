// The pictures of an imported scene.
#pragma once

#include <filesystem>
#include <string>

#include "scene/import/imported_scene.hpp"

namespace lucerna::scene {

// Fills Scene::textures, one for each of imported.textures, from the files they name (relative to
// `folder`) and settles what only the pictures can tell: opacity pictures become the alpha of their
// albedo, height maps and pictures that cannot be read leave the normal slots.
void loadTextures(ImportedScene& imported, const std::filesystem::path& folder);

// System B's emission textures (thesis 5.1.1, C.1): a picture of the name of a material's texture
// with "-map" behind it, in the same folder, becomes the material's emissive texture, with the same
// coordinates, unless it has one. Before loadTextures().
void addEmissionMaps(ImportedScene& imported, const std::filesystem::path& folder);

// The file that a scene file in `folder` means by `name`, which often is a path of another machine
// or of another case, or names another format: as given, then by its file name in the folder and in
// its subfolders of textures. Empty if there is none.
std::filesystem::path findTexture(const std::filesystem::path& folder, const std::string& name);

}  // namespace lucerna::scene
