// TORCS writes AC3D files with up to four textures a surface (.acc), which assimp misreads.
#pragma once

#include <string>
#include <string_view>

namespace lucerna::scene {

// The same file with the base texture only: lines "texture NAME tiled|skids|shad" are dropped, the
// word after a base texture's name is removed, and references keep their first texture coordinate.
std::string plainAc3d(std::string_view text);

}  // namespace lucerna::scene
