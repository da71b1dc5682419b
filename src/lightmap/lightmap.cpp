#include "lightmap/lightmap.hpp"

#include "core/file.hpp"
#include "core/hash.hpp"
#include "image/image_file.hpp"

namespace lucerna::lightmap {
namespace {

constexpr std::string_view kMakeAgain = "`lucerna bake ... --resume` makes it again";

}  // namespace

std::string faultOf(const Error& error) {
  std::string_view text = error.message;
  for (const std::string_view step : {std::string_view("bake the scene again"), kMakeAgain})
    if (text.ends_with(step)) text.remove_suffix(step.size() + 2);  // with "; " or ": "
  return std::string(text);
}

Result<Bytes> readEntry(const std::filesystem::path& folder, const FileEntry& entry) {
  const std::filesystem::path path = folder / entry.file;
  std::error_code none;
  if (!std::filesystem::exists(path, none))
    return error(ErrorKind::Input, "{}: is gone, and the manifest names it; {}", path.string(),
                 kMakeAgain);
  LUCERNA_TRY(bytes, readFile(path));
  const std::string found = hashText16(hashBytes(bytes));
  if (found != entry.hash)
    return error(ErrorKind::Input,
                 "{}: is damaged or of another bake: its hash is {}, wanted {} as the manifest "
                 "says; bake the scene again",
                 path.string(), found, entry.hash);
  return bytes;
}

Status checkEntry(const std::filesystem::path& folder, const FileEntry& entry) {
  LUCERNA_TRY(bytes, readEntry(folder, entry));
  return {};
}

Result<Manifest> readManifest(const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / "manifest.json";
  std::error_code none;
  if (!std::filesystem::exists(path, none))
    return error(ErrorKind::Input,
                 "'{}' holds no lightmap: there is no manifest.json; wanted the folder of a "
                 "finished `lucerna bake`",
                 folder.string());
  LUCERNA_TRY(text, readText(path, kMostManifestBytes));
  return manifestFrom(text, path.string());
}

Status checkEntries(const std::filesystem::path& folder, std::span<const FileEntry> entries) {
  for (const FileEntry& entry : entries) LUCERNA_TRY_VOID(checkEntry(folder, entry));
  return {};
}

Result<FileEntry> writeEntry(const std::filesystem::path& folder, const std::string& name,
                             std::span<const std::byte> bytes) {
  LUCERNA_TRY_VOID(writeFile(folder / name, bytes));
  return FileEntry{.file = name, .hash = hashText16(hashBytes(bytes))};
}

Result<Layout> readLayout(const std::filesystem::path& folder, const Manifest& manifest) {
  LUCERNA_TRY(bytes, readEntry(folder, manifest.layout));
  LUCERNA_TRY(layout, layoutFrom(bytes, (folder / manifest.layout.file).string()));
  if (layout.side != manifest.side || layout.maps != static_cast<int>(manifest.maps.size()))
    return error(ErrorKind::Input,
                 "{}: the layout has {} maps of {} texels a side, the manifest {} of {}; bake the "
                 "scene again",
                 (folder / "manifest.json").string(), layout.maps, layout.side,
                 manifest.maps.size(), manifest.side);
  return layout;
}

Result<Image> readMap(const std::filesystem::path& folder, const Manifest& manifest,
                      std::size_t index) {
  const MapEntry& map = manifest.maps[index];
  LUCERNA_TRY(bytes, readEntry(folder, map.master));
  const std::string name = (folder / map.master.file).string();
  LUCERNA_TRY(image, decodeImage(bytes, name));
  if (image.width() != manifest.side || image.height() != manifest.side)
    return error(ErrorKind::Input, "{}: found {} x {} pixels, wanted {} x {} as the manifest says",
                 name, image.width(), image.height(), manifest.side, manifest.side);
  return converted(image, ComponentType::F32, 3);
}

Result<Lightmap> readLightmap(const std::filesystem::path& folder) {
  Lightmap lightmap;
  LUCERNA_TRY(manifest, readManifest(folder));
  lightmap.manifest = std::move(manifest);
  LUCERNA_TRY(layout, readLayout(folder, lightmap.manifest));
  lightmap.layout = std::move(layout);
  for (std::size_t i = 0; i < lightmap.manifest.maps.size(); ++i) {
    LUCERNA_TRY(image, readMap(folder, lightmap.manifest, i));
    lightmap.maps.push_back(std::move(image));
  }
  for (const PatchEntry& entry : lightmap.manifest.patches) {
    LUCERNA_TRY(bytes, readEntry(folder, entry.patch));
    LUCERNA_TRY(patch, patchFrom(bytes, (folder / entry.patch.file).string()));
    lightmap.patches.push_back(std::move(patch));
  }
  return lightmap;
}

}  // namespace lucerna::lightmap
