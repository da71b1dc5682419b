// OBJ, AC3D, DAE, FBX, PLY and 3DS files, read by assimp in a child process.
#pragma once

#include <filesystem>

#include "core/child_process.hpp"
#include "core/result.hpp"
#include "scene/scene.hpp"

namespace lucerna::scene {

// A crash, a hang or a hunger for memory of the reader is an error that says so. Textures are
// loaded here: one that is missing is a warning and a checkerboard. complete() is left to the
// caller.
Result<Scene> importScene(const std::filesystem::path& path);

// What the child may use for a file of that size: 5 s, 384 MiB and an answer of 128 MiB, so that a
// small malformed file is done with in 10 s and 1 GiB of both processes; and more in step with the
// size, for honest large files.
ChildLimits importLimits(std::uint64_t fileBytes);

}  // namespace lucerna::scene
