#include "bake/write_gltf.hpp"

#include <algorithm>
#include <optional>

#include "bake/cancelled.hpp"
#include "core/log.hpp"
#include "core/parallel.hpp"
#include "image/image_file.hpp"
#include "lightmap/gltf_copy.hpp"
#include "lightmap/lightmap.hpp"

namespace lucerna::bake {
namespace {

namespace fs = std::filesystem;
using lightmap::FileEntry;

std::string pictureName(std::size_t map) {
  return fmt::format("map-{:03}.hdr", map);
}

Result<FileEntry> writePicture(const Image& map, const fs::path& folder, const std::string& name) {
  LUCERNA_TRY(bytes, encodeImage(folder / name, converted(map, ComponentType::F32, 3)));
  return lightmap::writeEntry(folder, name, bytes);
}

Status writePictures(const BakedLight& baked, const fs::path& folder,
                     std::vector<FileEntry>& files) {
  std::vector<std::optional<Result<FileEntry>>> entries(baked.maps.size());
  Progress progress("writing the glTF copy", entries.size());
  parallelFor(entries.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end && !Progress::cancelled(); ++i) {
      entries[i] = writePicture(baked.maps[i], folder, pictureName(i));
      progress.advance();
    }
  });
  LUCERNA_TRY_VOID(checkGoesOn());
  for (auto& entry : entries) {
    if (!*entry) return entry->error();
    files.push_back(std::move(**entry));
  }
  return {};
}

}  // namespace

Status writeGltf(const Plan& plan, const BakedLight& baked, const lightmap::Layout& layout,
                 const fs::path& folder, std::vector<FileEntry>& files) {
  LUCERNA_TRY_VOID(writePictures(baked, folder, files));
  std::vector<scene::GltfLightmap> pictures;
  for (std::size_t i = 0; i < baked.maps.size(); ++i)
    pictures.push_back({.file = pictureName(i), .intensity = 1.f});
  std::vector<std::uint32_t> lights;
  for (const scene::PlacedLight& light : plan.groups[0].lights)
    if (light.light != scene::kNone) lights.push_back(light.light);
  LUCERNA_TRY(copy, lightmap::writeGltfCopy(*plan.world.scene, layout, std::move(pictures), lights,
                                            folder));
  for (const std::string& note : copy.notes) log::info("scene.gltf: {}", note);
  std::ranges::move(copy.files, std::back_inserter(files));
  return {};
}

}  // namespace lucerna::bake
