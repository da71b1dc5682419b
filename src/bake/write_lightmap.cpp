#include "bake/write_lightmap.hpp"

#include <algorithm>
#include <optional>

#include "bake/bake_order.hpp"
#include "bake/cancelled.hpp"
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

// A map's files: what the manifest says of it, and its picture for the glTF copy.
struct MapFiles {
  lightmap::MapEntry entry;
  FileEntry picture;
};

Result<MapFiles> writeMap(const Plan& plan, const Image& map, std::size_t index,
                          const fs::path& folder) {
  const std::string name = fmt::format("map-{:03}.exr", index);
  MapFiles files;
  {
    LUCERNA_TRY(bytes, encodeImage(folder / name, map));
    LUCERNA_TRY(master, lightmap::writeEntry(folder, name, bytes));
    files.entry.master = std::move(master);
  }
  for (const Encoding encoding : plan.settings.encodings) {
    LUCERNA_TRY(encoded,
                writeCopy(map, index, encoding, folder, irradianceOfWhite(*plan.world.scene)));
    files.entry.encoded.push_back(std::move(encoded));
  }
  files.entry.largest = largestOf(map);
  LUCERNA_TRY(picture, writePicture(map, index, folder));
  files.picture = std::move(picture);
  return files;
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

// As asked for; else a quarter of what can be seen at once, as several groups may add up.
PatchTolerance toleranceOf(const Plan& plan) {
  const float light = plan.settings.patchTolerance ? kPi * *plan.settings.patchTolerance
                                                   : irradianceOfWhite(*plan.world.scene) / 1024.f;
  return {.light = light, .black = light / 16.f};
}

// A patch as its file, with what the manifest says of it.
struct PatchFile {
  lightmap::PatchEntry entry;
  Bytes bytes;
};

PatchFile patchOf(const PatchMaker& maker, const LightGroup& group,
                  const lightmap::HalfTiles& irradiance, const PatchTolerance& tolerance) {
  MadePatch made = maker.make(
      {.group = group.name, .color = colorOf(group), .irradiance = irradiance}, tolerance);
  PatchFile file{.entry = {}, .bytes = std::move(made.bytes)};
  file.entry.group = group.name;
  file.entry.form = made.patch.form();
  file.entry.bytes = file.bytes.size();
  file.entry.otherBytes = made.otherBytes;
  return file;
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
    manifest.objects.push_back(
        {.node = scene.nodes[scene.objects[object.object].node].name,
         .object = object.object,
         .charts = 0,
         .maps = {},
         .hash = lightmap::hashText16(lightmap::placeHash(scene, object.object))});
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

LightmapWriter::LightmapWriter(const Plan& plan, fs::path folder)
    : plan_(plan), folder_(std::move(folder)), layout_(layoutOf(plan)) {
  describeScene(plan, manifest_);
}

Result<LightmapWriter> LightmapWriter::begin(const Plan& plan, const fs::path& folder) {
  LUCERNA_TRY_VOID(claimFiles(plan, folder));
  LightmapWriter writer(plan, folder);
  LUCERNA_TRY(entry, lightmap::writeEntry(folder, kLayoutFile, lightmap::toBytes(writer.layout_)));
  writer.manifest_.layout = std::move(entry);
  return writer;
}

Status LightmapWriter::writeMaps(const std::vector<Image>& maps, const MapTexels& texels) {
  std::vector<std::optional<Result<MapFiles>>> files(maps.size());
  Progress progress("writing maps", maps.size());
  parallelFor(files.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end && !Progress::cancelled(); ++i) {
      files[i] = writeMap(plan_, maps[i], i, folder_);
      progress.advance();
    }
  });
  LUCERNA_TRY_VOID(checkGoesOn());
  for (std::size_t i = 0; i < files.size(); ++i) {
    if (!*files[i]) return files[i]->error();
    MapFiles& its = **files[i];
    its.entry.texels = static_cast<std::uint64_t>(std::ranges::count(texels.touched[i], true));
    manifest_.maps.push_back(std::move(its.entry));
    pictures_.push_back(std::move(its.picture));
  }
  if (plan_.groups.size() > 1) {
    used_ = usedTexels(texels);
    maker_ = std::make_unique<PatchMaker>(layout_, used_);
  }
  return {};
}

Status LightmapWriter::writePatches(const BakedLight& baked, const GroupRange& groups,
                                    Progress& progress) {
  const PatchTolerance tolerance = toleranceOf(plan_);
  std::vector<PatchFile> files(groups.last - groups.first);
  parallelFor(files.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end && !Progress::cancelled(); ++i) {
      const std::size_t group = groups.first + i;
      files[i] = patchOf(*maker_, plan_.groups[group], baked.groups[group], tolerance);
      progress.advance();
    }
  });
  LUCERNA_TRY_VOID(checkGoesOn());
  for (PatchFile& file : files) {
    const std::string name = fmt::format("patch-{:03}.bin", manifest_.patches.size());
    LUCERNA_TRY(entry, lightmap::writeEntry(folder_, name, file.bytes));
    file.entry.patch = std::move(entry);
    manifest_.patches.push_back(std::move(file.entry));
  }
  return {};
}

Status LightmapWriter::end() {
  manifest_.gltf = std::move(pictures_);
  LUCERNA_TRY_VOID(writeGltf(plan_, layout_, folder_, manifest_.gltf));
  LUCERNA_TRY_VOID(checkGoesOn());
  LUCERNA_TRY_VOID(writeText(folder_ / kManifestFile, lightmap::toJson(manifest_)));
  removeUnnamed(folder_, manifest_);
  return {};
}

std::uint64_t LightmapWriter::texels() const {
  std::uint64_t texels = 0;
  for (const lightmap::MapEntry& map : manifest_.maps) texels += map.texels;
  return texels;
}

}  // namespace lucerna::bake
