#include "bake/write_gltf.hpp"

#include <algorithm>

#include "core/log.hpp"
#include "image/image_file.hpp"
#include "lightmap/gltf_copy.hpp"
#include "lightmap/lightmap.hpp"

namespace lucerna::bake {
namespace {

std::string pictureName(std::size_t map) {
  return fmt::format("map-{:03}.hdr", map);
}

}  // namespace

Result<lightmap::FileEntry> writePicture(const Image& map, std::size_t index,
                                         const std::filesystem::path& folder) {
  const std::string name = pictureName(index);
  LUCERNA_TRY(bytes, encodeImage(folder / name, map));
  return lightmap::writeEntry(folder, name, bytes);
}

Status writeGltf(const Plan& plan, const lightmap::Layout& layout,
                 const std::filesystem::path& folder, std::vector<lightmap::FileEntry>& files) {
  std::vector<scene::GltfLightmap> pictures;
  for (std::size_t i = 0; i < static_cast<std::size_t>(layout.maps); ++i)
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
