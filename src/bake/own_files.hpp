// Which files of DIR are bakes' own. Nothing else is ever replaced or removed.
//
// manifest.json names those of a finished bake. Before another writes its first file, it lists in
// DIR/unfinished.json all that it may write, beside what was there already; the list goes when what
// it names and the new manifest does not is removed. So one that is killed at any time leaves
// nothing of which is not known that a bake has made it, whatever becomes of DIR/work.
#pragma once

#include <filesystem>
#include <string>

#include "bake/plan.hpp"
#include "core/result.hpp"
#include "lightmap/manifest.hpp"

namespace lucerna::bake {

inline constexpr const char* kUnfinishedFile = "unfinished.json";

// Whether a bake may write a file of that name into DIR.
bool isLightmapFile(const std::string& name);

// ErrorKind::Usage: DIR/work holds what is none of a bake's; so does DIR, and no bake is there, or
// it is named like a lightmap's file; the manifest is damaged, so that nothing says what is whose.
Status checkNoOthers(const std::filesystem::path& folder);

// Lists what a bake of the plan may write. Errors as above, or the list cannot be written.
Status claimFiles(const Plan& plan, const std::filesystem::path& folder);

// The error of who cannot read DIR. Where it lies in a bake that was stopped while it wrote there,
// it says that and how to go on.
Error orStopped(const Error& error, const std::filesystem::path& folder);

// Removes what is listed and the manifest does not name, then the list.
void removeUnnamed(const std::filesystem::path& folder, const lightmap::Manifest& manifest);

// The same of a DIR that is finished, and removes what bakes have left in DIR/work, that folder if
// nothing else is in it, and half files of writers that were killed. The lock that the caller has
// (bake/folder_lock.hpp) removes itself.
void removeWork(const std::filesystem::path& folder);

}  // namespace lucerna::bake
