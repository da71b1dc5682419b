#include "lightmap/gltf_copy.hpp"

#include "core/check.hpp"
#include "lightmap/place.hpp"

namespace lucerna::lightmap {
namespace {

// The headlight goes too: it is the viewer's.
void keepUnbaked(scene::Scene& scene, std::span<const std::uint32_t> baked) {
  std::vector<bool> goes(scene.lights.size(), false);
  for (const std::uint32_t light : baked)
    if (light < goes.size()) goes[light] = true;
  if (scene.headlight != scene::kNone) goes[scene.headlight] = true;
  std::vector<scene::Light> kept;
  for (std::size_t i = 0; i < goes.size(); ++i)
    if (!goes[i]) kept.push_back(std::move(scene.lights[i]));
  scene.lights = std::move(kept);
  scene.headlight = scene::kNone;
}

}  // namespace

Result<GltfCopy> writeGltfCopy(scene::Scene scene, const Layout& layout,
                               std::vector<scene::GltfLightmap> maps,
                               std::span<const std::uint32_t> baked,
                               const std::filesystem::path& folder) {
  CHECK(maps.size() == static_cast<std::size_t>(layout.maps));
  placeInMaps(scene, layout);
  keepUnbaked(scene, baked);
  LUCERNA_TRY(report, scene::writeGltf(scene, folder, {.lightmaps = std::move(maps)}));
  GltfCopy copy{.files = {}, .notes = std::move(report.notes)};
  for (const scene::GltfReport::File& file : report.files)
    copy.files.push_back({.file = file.name, .hash = hashText16(file.hash)});
  return copy;
}

}  // namespace lucerna::lightmap
