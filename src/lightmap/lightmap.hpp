// A baked folder, read whole: every file's hash is checked before it is used.
#pragma once

#include <filesystem>
#include <vector>

#include "image/image.hpp"
#include "lightmap/layout.hpp"
#include "lightmap/manifest.hpp"
#include "lightmap/patch.hpp"

namespace lucerna::lightmap {

struct Lightmap {
  Manifest manifest;
  Layout layout;
  std::vector<Image>
      maps;  // F32 RGB, irradiance (scene/light.hpp) of all lights that are always on
  std::vector<Patch> patches;  // as Manifest::patches: the groups that switch
};

// Errors (ErrorKind::Input) name the file: missing, damaged (its bytes have another hash than the
// manifest says), or not fitting the others.
Result<Lightmap> readLightmap(const std::filesystem::path& folder);

// One file of the folder, if its hash is right.
Result<Bytes> readEntry(const std::filesystem::path& folder, const FileEntry& entry);

}  // namespace lucerna::lightmap
