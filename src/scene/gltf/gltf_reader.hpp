// glTF 2.0 files, .gltf and .glb.
#pragma once

#include <filesystem>

#include "core/file.hpp"
#include "core/result.hpp"
#include "scene/outside_files.hpp"
#include "scene/scene.hpp"

namespace lucerna::scene {

// Reads the file's default scene (its first, if it names none; all root nodes, if it has no
// scenes). What can be repaired or left out becomes a sentence in Scene::warnings; anything else is
// an error that names the place in the JSON, what was found, what was wanted and the next step.
// updateTransforms() and complete() are left to the caller.
Result<Scene> readGltf(const std::filesystem::path& path);
// The same for the file's content. `path` stands for it in messages and says where the files lie
// that it names.
Result<Scene> readGltf(const std::filesystem::path& path, Bytes content, OutsideFiles outsideFiles);

}  // namespace lucerna::scene
