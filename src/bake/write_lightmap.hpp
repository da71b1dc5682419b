// A finished bake as files: maps, layout, a copy of the scene as glTF, manifest.
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "bake/assemble.hpp"
#include "bake/make_patch.hpp"
#include "bake/plan.hpp"
#include "core/progress.hpp"
#include "lightmap/manifest.hpp"

namespace lucerna::bake {

// Takes a bake part by part, so that no more of it than one part need be in memory: maps, then
// groups, then the rest. Every file is whole or not there; the manifest comes last, and then files
// of a bake that it does not name are removed: of an earlier one, or of one that was killed
// (bake/own_files.hpp). ErrorKind::Cancelled after Ctrl-C: the manifest is not written.
class LightmapWriter {
 public:
  // The plan outlives it. Writes the layout. ErrorKind::Usage: others' files are in the way.
  static Result<LightmapWriter> begin(const Plan& plan, const std::filesystem::path& folder);

  // Of all maps: masters, copies in other encodings, pictures for the glTF copy. texels: which of
  // them show light.
  Status writeMaps(const std::vector<Image>& maps, const MapTexels& texels);
  // After the maps; each group once, in rising order.
  Status writePatches(const BakedLight& baked, const GroupRange& groups, Progress& progress);
  // The glTF copy and the manifest.
  Status end();

  std::uint64_t texels() const;  // that lie on the scene

 private:
  LightmapWriter(const Plan& plan, std::filesystem::path folder);

  const Plan& plan_;
  std::filesystem::path folder_;
  lightmap::Layout layout_;
  lightmap::Manifest manifest_;
  std::vector<lightmap::FileEntry> pictures_;  // of the glTF copy
  std::vector<std::vector<bool>> used_;        // texels that lookups may meet, of each map
  std::unique_ptr<PatchMaker> maker_;
};

inline constexpr const char *kManifestFile = "manifest.json",  // the last that is written
    *kLayoutFile = "layout.bin";                               // the first

}  // namespace lucerna::bake
