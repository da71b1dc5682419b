#include "bake/map_copies.hpp"

#include <algorithm>
#include <optional>

#include "bake/bake_order.hpp"
#include "bake/cancelled.hpp"
#include "bake/folder_lock.hpp"
#include "bake/own_files.hpp"
#include "bake/shards.hpp"
#include "bake/write_lightmap.hpp"
#include "core/check.hpp"
#include "core/file.hpp"
#include "core/parallel.hpp"
#include "image/image_file.hpp"
#include "image/ktx2.hpp"
#include "lightmap/lightmap.hpp"

namespace lucerna::bake {
namespace {

namespace fs = std::filesystem;
using lightmap::FileEntry;
using lightmap::Manifest;

std::string nameOf(std::size_t index, Encoding encoding) {
  const char* ends[] = {"rgb9e5.ktx2", "bc6h.ktx2", "png"};  // as Encoding
  return fmt::format("map-{:03}.{}", index, ends[static_cast<std::size_t>(encoding)]);
}

// What viewers show: sRGB of a white surface at the scene's exposure.
Image pictureOf(const Image& map, float white) {
  Image picture(map.width(), map.height(), 3, ComponentType::U8);
  for (int y = 0; y < map.height(); ++y)
    for (int x = 0; x < map.width(); ++x)
      for (int c = 0; c < 3; ++c)
        picture.pixel<std::uint8_t>(x, y)[c] = static_cast<std::uint8_t>(
            255.f * srgbFromLinear(floatFromHalf(map.pixel<std::uint16_t>(x, y)[c]) / white) +
            0.5f);
  return picture;
}

Result<Bytes> encoded(const Image& map, Encoding encoding, const fs::path& path, float white) {
  switch (encoding) {
    case Encoding::Rgb9e5:
      return encodeKtx2({&map, 1}, HdrFormat::Rgb9e5);
    case Encoding::Bc6h:
      return encodeKtx2({&map, 1}, HdrFormat::Bc6h);
    case Encoding::Png:
      return encodeImage(path, pictureOf(map, white));
  }
  CHECK(false);
}

// The master as the bake had it, in half floats.
Result<Image> readMaster(const fs::path& folder, const FileEntry& entry) {
  LUCERNA_TRY(bytes, lightmap::readEntry(folder, entry));
  LUCERNA_TRY(image, decodeImage(bytes, (folder / entry.file).string()));
  return converted(image, ComponentType::Half, 3);
}

// Of one map; copies that are there stay.
Result<std::vector<FileEntry>> completed(const Plan& plan, const lightmap::MapEntry& map,
                                         std::size_t index, const fs::path& folder) {
  LUCERNA_TRY(master, readMaster(folder, map.master));
  std::vector<FileEntry> copies;
  for (const Encoding encoding : plan.settings.encodings) {
    const auto there = std::ranges::find(map.encoded, nameOf(index, encoding), &FileEntry::file);
    if (there != map.encoded.end()) {
      copies.push_back(*there);
      continue;
    }
    LUCERNA_TRY(copy,
                writeCopy(master, index, encoding, folder, irradianceOfWhite(*plan.world.scene)));
    copies.push_back(std::move(copy));
  }
  return copies;
}

Status completeMaps(const Plan& plan, const fs::path& folder, Manifest& manifest) {
  std::vector<std::optional<Result<std::vector<FileEntry>>>> copies(manifest.maps.size());
  Progress progress("writing copies of maps", copies.size());
  parallelFor(copies.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end && !Progress::cancelled(); ++i) {
      copies[i] = completed(plan, manifest.maps[i], i, folder);
      progress.advance();
    }
  });
  LUCERNA_TRY_VOID(checkGoesOn());
  for (std::size_t i = 0; i < copies.size(); ++i) {
    if (!*copies[i]) return copies[i]->error();
    manifest.maps[i].encoded = std::move(**copies[i]);
  }
  return {};
}

// The manifest of this very bake without copies that it should have, if DIR holds one.
std::optional<Manifest> lackingCopies(const Plan& plan, const fs::path& folder) {
  auto manifest = lightmap::readManifest(folder);
  if (!manifest || manifest->sceneHash != lightmap::hashText16(plan.hash) ||
      !lacksCopiesAlone(manifest->settings, plan.settings))
    return {};
  return std::move(*manifest);
}

}  // namespace

Result<FileEntry> writeCopy(const Image& map, std::size_t index, Encoding encoding,
                            const fs::path& folder, float white) {
  const std::string name = nameOf(index, encoding);
  LUCERNA_TRY(bytes, encoded(map, encoding, folder / name, white));
  return lightmap::writeEntry(folder, name, bytes);
}

std::vector<Encoding> copiesBeside(const Plan& plan, const fs::path& folder) {
  std::error_code none;
  if (fs::exists(orderPath(folder), none)) return {};
  const auto manifest = lightmap::readManifest(folder);
  if (!manifest || manifest->sceneHash != lightmap::hashText16(plan.hash)) return {};
  return furtherCopies(manifest->settings, plan.settings);
}

Result<AddedCopies> addCopies(const Plan& plan, const fs::path& folder) {
  if (!lackingCopies(plan, folder)) return AddedCopies();
  LUCERNA_TRY(lock, FolderLock::take(folder, FolderLock::Use::Write));
  std::optional<Manifest> manifest = lackingCopies(plan, folder);  // as nobody changes it any more
  if (!manifest) return AddedCopies();
  LUCERNA_TRY(before, settingsFrom(manifest->settings, (folder / kManifestFile).string()));
  LUCERNA_TRY_VOID(lightmap::checkEntries(folder, lightmap::filesOf(*manifest)));
  LUCERNA_TRY_VOID(claimFiles(plan, folder));
  LUCERNA_TRY_VOID(completeMaps(plan, folder, *manifest));
  manifest->settings = settingsText(plan.settings);
  LUCERNA_TRY_VOID(writeText(folder / kManifestFile, lightmap::toJson(*manifest)));
  removeUnnamed(folder, *manifest);
  return AddedCopies{.maps = manifest->maps.size(),
                     .copies = furtherCopies(manifest->settings, before)};
}

}  // namespace lucerna::bake
