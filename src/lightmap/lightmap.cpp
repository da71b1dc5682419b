#include "lightmap/lightmap.hpp"

#include "core/file.hpp"
#include "core/hash.hpp"
#include "image/image_file.hpp"

namespace lucerna::lightmap {
namespace {

Result<Image> readMap(const std::filesystem::path& folder, const MapEntry& map, int side) {
  LUCERNA_TRY(bytes, readEntry(folder, map.master));
  const std::string name = (folder / map.master.file).string();
  LUCERNA_TRY(image, decodeImage(bytes, name));
  if (image.width() != side || image.height() != side)
    return error(ErrorKind::Input, "{}: found {} x {} pixels, wanted {} x {} as the manifest says",
                 name, image.width(), image.height(), side, side);
  return converted(image, ComponentType::F32, 3);
}

}  // namespace

Result<Bytes> readEntry(const std::filesystem::path& folder, const FileEntry& entry) {
  const std::filesystem::path path = folder / entry.file;
  LUCERNA_TRY(bytes, readFile(path));
  const std::string found = hashText16(hashBytes(bytes));
  if (found != entry.hash)
    return error(ErrorKind::Input,
                 "{}: is damaged or of another bake: its hash is {}, wanted {} as the manifest "
                 "says; bake the scene again",
                 path.string(), found, entry.hash);
  return bytes;
}

Result<Lightmap> readLightmap(const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / "manifest.json";
  std::error_code none;
  if (!std::filesystem::exists(path, none))
    return error(ErrorKind::Input,
                 "'{}' holds no lightmap: there is no manifest.json; wanted the folder of a "
                 "finished `lucerna bake`",
                 folder.string());
  LUCERNA_TRY(text, readText(path));
  Lightmap lightmap;
  LUCERNA_TRY(manifest, manifestFrom(text, path.string()));
  lightmap.manifest = std::move(manifest);
  const Manifest& m = lightmap.manifest;
  LUCERNA_TRY(layoutBytes, readEntry(folder, m.layout));
  LUCERNA_TRY(layout, layoutFrom(layoutBytes, (folder / m.layout.file).string()));
  if (layout.side != m.side || layout.maps != static_cast<int>(m.maps.size()))
    return error(ErrorKind::Input,
                 "{}: the layout has {} maps of {} texels a side, the manifest {} of {}; bake the "
                 "scene again",
                 path.string(), layout.maps, layout.side, m.maps.size(), m.side);
  lightmap.layout = std::move(layout);
  for (const MapEntry& map : m.maps) {
    LUCERNA_TRY(image, readMap(folder, map, m.side));
    lightmap.maps.push_back(std::move(image));
  }
  for (const PatchEntry& entry : m.patches) {
    LUCERNA_TRY(bytes, readEntry(folder, entry.patch));
    LUCERNA_TRY(patch, patchFrom(bytes, (folder / entry.patch.file).string()));
    lightmap.patches.push_back(std::move(patch));
  }
  return lightmap;
}

}  // namespace lucerna::lightmap
