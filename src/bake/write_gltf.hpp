// The part of a finished bake that other programs read: the scene as glTF, and its maps as
// pictures that these know. docs/user/gltf-copy.md.
#pragma once

#include <filesystem>
#include <vector>

#include "bake/plan.hpp"
#include "image/image.hpp"
#include "lightmap/manifest.hpp"

namespace lucerna::bake {

// A map as the copy names it.
Result<lightmap::FileEntry> writePicture(const Image& map, std::size_t index,
                                         const std::filesystem::path& folder);

// Writes scene.gltf and what it names but these pictures. files: all of these are added. What glTF
// cannot say is told in the log.
Status writeGltf(const Plan& plan, const lightmap::Layout& layout,
                 const std::filesystem::path& folder, std::vector<lightmap::FileEntry>& files);

}  // namespace lucerna::bake
