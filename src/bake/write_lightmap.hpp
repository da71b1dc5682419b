// A finished bake as files: maps, layout, a copy of the scene as glTF, manifest.
#pragma once

#include <filesystem>

#include "bake/assemble.hpp"
#include "bake/plan.hpp"

namespace lucerna::bake {

// Every file is whole or not there; the manifest comes last, and then files of an earlier bake that
// it does not name are removed. texels: how many lie on the scene, for the report.
Status writeLightmap(const Plan& plan, const BakedLight& baked, const std::filesystem::path& folder,
                     std::uint64_t& texels);

}  // namespace lucerna::bake
