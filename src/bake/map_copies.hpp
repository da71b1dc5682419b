// Copies of maps in the encodings that were asked for, beside their EXR masters.
#pragma once

#include <filesystem>
#include <span>

#include "bake/plan.hpp"
#include "image/image.hpp"
#include "lightmap/manifest.hpp"

namespace lucerna::bake {

// map: as BakedLight::maps; white: irradianceOfWhite(), for PNG.
Result<lightmap::FileEntry> writeCopy(const Image& map, std::size_t index, Encoding encoding,
                                      const std::filesystem::path& folder, float white);

// The copies that DIR has and the plan does not ask for, where it holds this very bake otherwise,
// finished, and nothing to go on with.
std::vector<Encoding> copiesBeside(const Plan& plan, const std::filesystem::path& folder);

// Where DIR holds this very bake, finished, but for copies that it has not: writes them from the
// masters, and the manifest, all as a bake with these settings does. Of 0 maps: it
// is another bake, or nothing is missing. ErrorKind::Input: a file is damaged. ErrorKind::Usage:
// others' files are in the way. ErrorKind::Failed: another process bakes into DIR.
// ErrorKind::Cancelled after Ctrl-C: the lightmap is as it was, some copies lie beside it.
struct AddedCopies {
  std::size_t maps = 0;
  std::vector<Encoding> copies;  // of each of them
};
Result<AddedCopies> addCopies(const Plan& plan, const std::filesystem::path& folder);

}  // namespace lucerna::bake
