#include "bake/write_lightmap.hpp"

#include <algorithm>
#include <optional>
#include <set>

#include "bake/bake_order.hpp"
#include "core/file.hpp"
#include "core/hash.hpp"
#include "core/parallel.hpp"
#include "core/progress.hpp"
#include "image/image_file.hpp"
#include "lightmap/manifest.hpp"

namespace lucerna::bake {
namespace {

namespace fs = std::filesystem;
using lightmap::FileEntry;
using lightmap::Manifest;

Result<FileEntry> write(const fs::path& folder, const std::string& name,
                        std::span<const std::byte> bytes) {
  LUCERNA_TRY_VOID(writeFile(folder / name, bytes));
  return FileEntry{.file = name, .hash = lightmap::hashText16(hashBytes(bytes))};
}

vec3 largestOf(const Image& map) {
  vec3 largest(0.f);
  for (int y = 0; y < map.height(); ++y)
    for (int x = 0; x < map.width(); ++x) {
      const std::uint16_t* p = map.pixel<std::uint16_t>(x, y);
      largest =
          glm::max(largest, vec3(floatFromHalf(p[0]), floatFromHalf(p[1]), floatFromHalf(p[2])));
    }
  return largest;
}

Result<lightmap::MapEntry> writeMap(const BakedLight& baked, std::size_t index,
                                    const fs::path& folder) {
  const std::string name = fmt::format("map-{:03}.exr", index);
  LUCERNA_TRY(bytes, encodeImage(folder / name, baked.maps[index]));
  lightmap::MapEntry entry;
  LUCERNA_TRY(master, write(folder, name, bytes));
  entry.master = std::move(master);
  entry.largest = largestOf(baked.maps[index]);
  entry.texels = static_cast<std::uint64_t>(std::ranges::count(baked.texels.touched[index], true));
  return entry;
}

Status writeMaps(const BakedLight& baked, const fs::path& folder, Manifest& manifest) {
  std::vector<std::optional<Result<lightmap::MapEntry>>> entries(baked.maps.size());
  Progress progress("writing maps", baked.maps.size());
  parallelFor(entries.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      entries[i] = writeMap(baked, i, folder);
      progress.advance();
    }
  });
  for (auto& entry : entries) {
    if (!*entry) return entry->error();
    manifest.maps.push_back(std::move(**entry));
  }
  return {};
}

void describeScene(const Plan& plan, Manifest& manifest) {
  const scene::Scene& scene = *plan.world.scene;
  manifest.scene = scene.name;
  manifest.sceneHash = lightmap::hashText16(plan.hash);
  manifest.settings = settingsText(plan.settings);
  manifest.side = plan.settings.pack.side;
  manifest.density = plan.settings.density;
  for (const WorldObject& object : plan.world.objects)
    manifest.objects.push_back({.node = scene.nodes[scene.objects[object.object].node].name,
                                .object = object.object,
                                .charts = 0,
                                .maps = {}});
  for (std::size_t i = 0; i < plan.charts.charts.size(); ++i) {
    lightmap::ObjectEntry& object = manifest.objects[plan.charts.charts[i].object];
    ++object.charts;
    const int map = plan.packed.packing.places[i].map;
    if (std::ranges::find(object.maps, map) == object.maps.end()) object.maps.push_back(map);
  }
  for (lightmap::ObjectEntry& object : manifest.objects) std::ranges::sort(object.maps);
  for (const LightGroup& group : plan.groups)
    for (const scene::PlacedLight& light : group.lights)
      manifest.lights.push_back(
          {.name = scene.lights[light.light].name, .group = group.name, .light = light.light});
}

std::set<std::string> namesIn(const Manifest& manifest) {
  std::set<std::string> names{"manifest.json"};
  for (const FileEntry& entry : lightmap::filesOf(manifest)) names.insert(entry.file);
  return names;
}

// What an earlier bake left in the folder: names that its manifest gives, and ours does not.
void removeOthers(const fs::path& folder, const std::set<std::string>& before,
                  const std::set<std::string>& now) {
  std::error_code ignored;
  for (const std::string& name : before)
    if (!now.contains(name)) fs::remove(folder / name, ignored);
}

std::set<std::string> namesBefore(const fs::path& folder) {
  const Result<std::string> text = readText(folder / "manifest.json");
  if (!text) return {};
  const Result<Manifest> manifest = lightmap::manifestFrom(*text, "manifest.json");
  return manifest ? namesIn(*manifest) : std::set<std::string>();
}

}  // namespace

Status writeLightmap(const Plan& plan, const BakedLight& baked, const fs::path& folder,
                     std::uint64_t& texels) {
  const std::set<std::string> before = namesBefore(folder);
  Manifest manifest;
  describeScene(plan, manifest);
  LUCERNA_TRY(layout, write(folder, "layout.bin", lightmap::toBytes(layoutOf(plan))));
  manifest.layout = std::move(layout);
  LUCERNA_TRY_VOID(writeMaps(baked, folder, manifest));
  texels = 0;
  for (const lightmap::MapEntry& map : manifest.maps) texels += map.texels;
  LUCERNA_TRY_VOID(writeText(folder / "manifest.json", lightmap::toJson(manifest)));
  removeOthers(folder, before, namesIn(manifest));
  return {};
}

}  // namespace lucerna::bake
