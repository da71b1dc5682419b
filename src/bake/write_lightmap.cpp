#include "bake/write_lightmap.hpp"

#include <algorithm>
#include <optional>

#include "bake/bake_order.hpp"
#include "bake/cancelled.hpp"
#include "bake/make_patch.hpp"
#include "bake/map_copies.hpp"
#include "bake/own_files.hpp"
#include "bake/write_gltf.hpp"
#include "core/file.hpp"
#include "core/hash.hpp"
#include "core/parallel.hpp"
#include "image/image_file.hpp"
#include "lightmap/lightmap.hpp"
#include "lightmap/scene_hash.hpp"

namespace lucerna::bake {
namespace {

namespace fs = std::filesystem;
using lightmap::FileEntry;
using lightmap::Manifest;

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

Result<lightmap::MapEntry> writeMap(const Plan& plan, const BakedLight& baked, std::size_t index,
                                    const fs::path& folder) {
  const std::string name = fmt::format("map-{:03}.exr", index);
  LUCERNA_TRY(bytes, encodeImage(folder / name, baked.maps[index]));
  lightmap::MapEntry entry;
  LUCERNA_TRY(master, lightmap::writeEntry(folder, name, bytes));
  entry.master = std::move(master);
  for (const Encoding encoding : plan.settings.encodings) {
    LUCERNA_TRY(encoded, writeCopy(baked.maps[index], index, encoding, folder,
                                   irradianceOfWhite(*plan.world.scene)));
    entry.encoded.push_back(std::move(encoded));
  }
  entry.largest = largestOf(baked.maps[index]);
  entry.texels = static_cast<std::uint64_t>(std::ranges::count(baked.texels.touched[index], true));
  return entry;
}

Status writeMaps(const Plan& plan, const BakedLight& baked, const fs::path& folder,
                 Manifest& manifest) {
  std::vector<std::optional<Result<lightmap::MapEntry>>> entries(baked.maps.size());
  Progress progress("writing maps", baked.maps.size());
  parallelFor(entries.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end && !Progress::cancelled(); ++i) {
      entries[i] = writeMap(plan, baked, i, folder);
      progress.advance();
    }
  });
  LUCERNA_TRY_VOID(checkGoesOn());
  for (auto& entry : entries) {
    if (!*entry) return entry->error();
    manifest.maps.push_back(std::move(**entry));
  }
  return {};
}

// What is factored out of a group's light: the mean of its lights, so that what is stored of lights
// of one colour has none.
vec3 colorOf(const LightGroup& group) {
  vec3 sum(0.f);
  for (const scene::PlacedLight& light : group.lights) sum += light.intensity;
  return group.lights.empty() ? vec3(1.f) : sum / static_cast<float>(group.lights.size());
}

// The texels that a lookup may meet: on the scene, and the filled ones beside them.
std::vector<std::vector<bool>> usedTexels(const MapTexels& texels) {
  std::vector<std::vector<bool>> used = texels.touched;
  const int side = texels.side;
  for (std::size_t map = 0; map < used.size(); ++map)
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x)
        if (texels.isBeside(static_cast<int>(map), {x, y}))
          used[map][static_cast<std::size_t>(y) * side + x] = true;
  return used;
}

MadePatch makePatch(const PatchMaker& maker, const LightGroup& group, std::span<const LitTexel> lit,
                    const PatchTolerance& tolerance) {
  std::vector<PatchTexel> texels;
  texels.reserve(lit.size());
  for (const LitTexel& t : lit)
    texels.push_back(
        {.map = t.map,
         .x = t.x,
         .y = t.y,
         .value = {floatFromHalf(t.rgb[0]), floatFromHalf(t.rgb[1]), floatFromHalf(t.rgb[2])}});
  return maker.make({.group = group.name, .color = colorOf(group), .texels = texels}, tolerance);
}

// As asked for; else a quarter of what can be seen at once, as several groups may add up.
PatchTolerance toleranceOf(const Plan& plan) {
  const float light = plan.settings.patchTolerance ? kPi * *plan.settings.patchTolerance
                                                   : irradianceOfWhite(*plan.world.scene) / 1024.f;
  return {.light = light, .black = light / 16.f};
}

Status writePatches(const Plan& plan, const BakedLight& baked, const lightmap::Layout& layout,
                    const fs::path& folder, Manifest& manifest) {
  if (plan.groups.size() < 2) return {};
  const std::vector<std::vector<bool>> used = usedTexels(baked.texels);
  const PatchMaker maker(layout, used);
  const PatchTolerance tolerance = toleranceOf(plan);
  std::vector<MadePatch> made(plan.groups.size());
  Progress progress("making patches", made.size() - 1);
  parallelFor(made.size() - 1, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin + 1; i < end + 1 && !Progress::cancelled(); ++i) {
      made[i] = makePatch(maker, plan.groups[i], baked.groups[i], tolerance);
      progress.advance();
    }
  });
  for (std::size_t i = 1; i < made.size(); ++i) {
    LUCERNA_TRY_VOID(checkGoesOn());
    lightmap::PatchEntry entry;
    entry.group = plan.groups[i].name;
    LUCERNA_TRY(file,
                lightmap::writeEntry(folder, fmt::format("patch-{:03}.bin", i - 1), made[i].bytes));
    entry.patch = std::move(file);
    entry.form = made[i].patch.form();
    entry.bytes = made[i].bytes.size();
    entry.otherBytes = made[i].otherBytes;
    manifest.patches.push_back(std::move(entry));
  }
  return {};
}

void describeScene(const Plan& plan, Manifest& manifest) {
  const scene::Scene& scene = *plan.world.scene;
  manifest.scene = scene.name;
  manifest.sceneHash = lightmap::hashText16(plan.hash);
  manifest.geometryHash = lightmap::hashText16(lightmap::geometryHash(scene));
  manifest.settings = settingsText(plan.settings);
  manifest.processor = rayInstructionSet();
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
      if (light.light != scene::kNone)
        manifest.lights.push_back(
            {.name = scene.lights[light.light].name,
             .group = group.name,
             .light = light.light,
             .hash = lightmap::hashText16(lightmap::lightHash(scene, light.light))});
}

}  // namespace

Status writeLightmap(const Plan& plan, const BakedLight& baked, const fs::path& folder,
                     std::uint64_t& texels) {
  LUCERNA_TRY_VOID(claimFiles(plan, folder));
  Manifest manifest;
  describeScene(plan, manifest);
  const lightmap::Layout layout = layoutOf(plan);
  LUCERNA_TRY(entry, lightmap::writeEntry(folder, kLayoutFile, lightmap::toBytes(layout)));
  manifest.layout = std::move(entry);
  LUCERNA_TRY_VOID(writeMaps(plan, baked, folder, manifest));
  LUCERNA_TRY_VOID(writePatches(plan, baked, layout, folder, manifest));
  LUCERNA_TRY_VOID(writeGltf(plan, baked, layout, folder, manifest.gltf));
  LUCERNA_TRY_VOID(checkGoesOn());
  texels = 0;
  for (const lightmap::MapEntry& map : manifest.maps) texels += map.texels;
  LUCERNA_TRY_VOID(writeText(folder / kManifestFile, lightmap::toJson(manifest)));
  removeUnnamed(folder, manifest);
  return {};
}

}  // namespace lucerna::bake
