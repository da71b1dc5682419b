// A finished bake as files: maps, layout, a copy of the scene as glTF, manifest.
#pragma once

#include <filesystem>

#include "bake/assemble.hpp"
#include "bake/plan.hpp"

namespace lucerna::bake {

// Every file is whole or not there; the manifest comes last, and then files of a bake that it does
// not name are removed: of an earlier one, or of one that was killed (bake/own_files.hpp). texels:
// how many lie on the scene, for the report. ErrorKind::Cancelled after Ctrl-C: the manifest is not
// written. ErrorKind::Usage: others' files are in the way.
Status writeLightmap(const Plan& plan, const BakedLight& baked, const std::filesystem::path& folder,
                     std::uint64_t& texels);

inline constexpr const char *kManifestFile = "manifest.json",  // the last that is written
    *kLayoutFile = "layout.bin";                               // the first

}  // namespace lucerna::bake
