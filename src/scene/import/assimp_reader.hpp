// Reads a file with assimp, in this process: for the import worker only, because assimp may crash,
// hang or exhaust memory on hostile files.
#pragma once

#include <filesystem>

#include "core/result.hpp"
#include "scene/import/imported_scene.hpp"

namespace lucerna::scene {

Result<ImportedScene> readWithAssimp(const std::filesystem::path& path);

}  // namespace lucerna::scene
