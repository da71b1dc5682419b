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

// Its parts, for who needs not all at once; errors as above.
// A manifest of ten million objects and named lights has about as many bytes.
inline constexpr std::uint64_t kMostManifestBytes = 1ull << 30;
Result<Manifest> readManifest(const std::filesystem::path& folder);
Result<Layout> readLayout(const std::filesystem::path& folder, const Manifest& manifest);
Result<Image> readMap(const std::filesystem::path& folder, const Manifest& manifest,
                      std::size_t index);

// What an error of these says, without the next step: for who names another.
std::string faultOf(const Error& error);

// One file of the folder, if its hash is right.
Result<Bytes> readEntry(const std::filesystem::path& folder, const FileEntry& entry);
Status checkEntry(const std::filesystem::path& folder, const FileEntry& entry);
Status checkEntries(const std::filesystem::path& folder, std::span<const FileEntry> entries);

// Writes a file of the folder, whole or not at all.
Result<FileEntry> writeEntry(const std::filesystem::path& folder, const std::string& name,
                             std::span<const std::byte> bytes);

}  // namespace lucerna::lightmap
