// The part of a finished bake that other programs read: the scene as glTF, and its maps as
// pictures that these know. docs/user/gltf-copy.md.
#pragma once

#include <filesystem>
#include <vector>

#include "bake/assemble.hpp"
#include "bake/plan.hpp"
#include "lightmap/manifest.hpp"

namespace lucerna::bake {

// Writes scene.gltf and what it names. files: all of these are added. What glTF cannot say is told
// in the log.
Status writeGltf(const Plan& plan, const BakedLight& baked, const lightmap::Layout& layout,
                 const std::filesystem::path& folder, std::vector<lightmap::FileEntry>& files);

}  // namespace lucerna::bake
