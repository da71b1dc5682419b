// lucerna lightmap merge|inspect

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>

#include "bake/bake.hpp"
#include "bake/bake_order.hpp"
#include "bake/own_files.hpp"
#include "command_line.hpp"
#include "core/file.hpp"
#include "core/log.hpp"
#include "core/parallel.hpp"
#include "core/progress.hpp"
#include "core/text.hpp"
#include "image/image_file.hpp"
#include "lightmap/lightmap.hpp"
#include "lightmap/pictures.hpp"
#include "scene/load.hpp"

namespace lucerna::cli {
namespace {

namespace fs = std::filesystem;
using bake::FolderLock;

struct Options {
  std::string folder, scene, output;
  std::optional<float> exposure;
  int threads = 0;
};

// merge

// Whether the folder is a whole lightmap already, without anything to merge.
Result<bool> isMerged(const std::string& folder) {
  std::error_code none;
  if (fs::exists(bake::orderPath(folder), none) ||
      !fs::exists(fs::path(folder) / "manifest.json", none))
    return false;
  LUCERNA_TRY(manifest, lightmap::readManifest(folder));
  LUCERNA_TRY_VOID(lightmap::checkEntries(folder, lightmap::filesOf(manifest)));
  return true;
}

Result<int> merge(const Options& options, bool json) {
  setThreadCount(options.threads);
  LUCERNA_TRY(merged, isMerged(options.folder));
  Json document{{"folder", options.folder}, {"finished", true}};
  if (merged) {
    // Another process may be at that just now.
    if (const auto lock = FolderLock::take(options.folder, FolderLock::Use::Write); lock)
      bake::removeWork(options.folder);
    log::info("'{}' is finished; nothing is left to merge", options.folder);
  } else {
    LUCERNA_TRY(order, bake::readOrder(options.folder));
    LUCERNA_TRY(lock, FolderLock::take(options.folder, FolderLock::Use::Write));
    const std::string& path = options.scene.empty() ? order.scene : options.scene;
    LUCERNA_TRY_VOID(bake::checkIsApart(options.folder, path));
    LUCERNA_TRY(scene, scene::loadScene(path));
    scene::animate(scene, 0.f);
    LUCERNA_TRY(plan, bake::makePlan(scene, order.settings));
    LUCERNA_TRY_VOID(bake::keepOrder(options.folder, bake::orderOf(plan, path)));
    bake::BakeReport report;
    LUCERNA_TRY_VOID(bake::finish(plan, options.folder, report));
    log::info("wrote {}", options.folder);
    document["maps"] = plan.packed.packing.maps;
    document["texels"] = report.texels;
    document["seconds"] = report.seconds.finish;
  }
  if (json) printJson(document);
  return 0;
}

// With the next step after Ctrl-C.
Result<int> mergeOrCancel(const Options& options, bool json) {
  auto result = merge(options, json);
  if (result || result.error().kind != ErrorKind::Cancelled) return result;
  return error(ErrorKind::Cancelled,
               "cancelled; what the shards have lit is kept in '{}': the same command merges it",
               options.folder);
}

// inspect

struct MapTable {
  std::string file;
  std::uint64_t texels = 0, overlaps = 0, unsound = 0, bytes = 0;  // of unsound values
  double used = 0., least = 0., most = 0., mean = 0.;              // used: share; irradiance
  double leastDensity = 0., mostDensity = 0.;                      // texels/m; 0: no scene given
};

struct Inspected {
  lightmap::Manifest manifest;
  lightmap::Layout layout;
  std::vector<std::vector<float>> densities;  // empty: no scene given
  std::vector<lightmap::Patch> patches;
  std::vector<MapTable> maps;
  std::vector<std::string> files;  // written
  float factor = 1.f;              // of tonePicture()
};

double luminance(const float* rgb) {
  return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
}

void addLight(MapTable& table, const Image& map, const lightmap::ChartTexels& texels) {
  double sum = 0.;
  std::uint64_t count = 0, sound = 0;
  for (int y = 0; y < texels.side; ++y)
    for (int x = 0; x < texels.side; ++x) {
      if (texels.at(x, y) == lightmap::ChartTexels::kNothing) continue;
      const double value = luminance(map.pixel<float>(x, y));
      ++count;
      if (!std::isfinite(value) || value < 0.) {
        ++table.unsound;
        continue;
      }
      table.least = ++sound == 1 ? value : std::min(table.least, value);
      table.most = std::max(table.most, value);
      sum += value;
    }
  table.texels = count;
  table.used = static_cast<double>(count) / (static_cast<double>(texels.side) * texels.side);
  table.mean = sound > 0 ? sum / static_cast<double>(sound) : 0.;
  table.overlaps = texels.overlaps.size();
}

void addDensity(MapTable& table, const Inspected& all, int map) {
  for (std::size_t i = 0; i < all.densities.size(); ++i)
    for (std::size_t k = 0; k < all.densities[i].size(); ++k) {
      const double density = all.densities[i][k];
      if (density == 0. || all.layout.objects[i][k].map != map) continue;
      table.leastDensity =
          table.leastDensity == 0. ? density : std::min(table.leastDensity, density);
      table.mostDensity = std::max(table.mostDensity, density);
    }
}

Result<std::uint64_t> bytesOf(const fs::path& folder, const lightmap::MapEntry& map) {
  std::uint64_t bytes = 0;
  std::vector<lightmap::FileEntry> entries{map.master};
  entries.insert(entries.end(), map.encoded.begin(), map.encoded.end());
  for (const lightmap::FileEntry& entry : entries) {
    LUCERNA_TRY(read, lightmap::readEntry(folder, entry));
    bytes += read.size();
  }
  return bytes;
}

Status write(Inspected& all, const fs::path& path, const Image& image) {
  LUCERNA_TRY_VOID(writeImage(path, image));
  all.files.push_back(path.string());
  return {};
}

Status writePictures(Inspected& all, const fs::path& folder, int map, const Image& light,
                     const lightmap::ChartTexels& texels) {
  const auto path = [&](const char* what) {
    return folder / fmt::format("{}-{:03}.png", what, map);
  };
  LUCERNA_TRY_VOID(write(all, path("light"), lightmap::tonePicture(light, all.factor)));
  LUCERNA_TRY_VOID(write(all, path("charts"), lightmap::chartPicture(texels)));
  LUCERNA_TRY_VOID(write(all, path("validity"), lightmap::validityPicture(texels, light)));
  LUCERNA_TRY_VOID(write(all, path("seams"), lightmap::seamPicture(texels)));
  if (!all.densities.empty())
    LUCERNA_TRY_VOID(
        write(all, path("density"),
              lightmap::densityPicture(all.layout, map, all.densities, all.manifest.density)));
  for (std::size_t i = 0; i < all.patches.size(); ++i)
    if (lightmap::lights(all.patches[i], map))
      LUCERNA_TRY_VOID(write(all, folder / fmt::format("patch-{:03}-{:03}.png", i, map),
                             lightmap::patchPicture(all.patches[i], map)));
  return {};
}

Status inspectMap(Inspected& all, const Options& options, std::size_t index) {
  const lightmap::MapEntry& entry = all.manifest.maps[index];
  MapTable table{.file = entry.master.file};
  LUCERNA_TRY(bytes, bytesOf(options.folder, entry));
  table.bytes = bytes;
  LUCERNA_TRY(light, lightmap::readMap(options.folder, all.manifest, index));
  const auto map = static_cast<int>(index);
  const lightmap::ChartTexels texels = lightmap::chartTexels(all.layout, map);
  addLight(table, light, texels);
  addDensity(table, all, map);
  all.maps.push_back(std::move(table));
  if (options.output.empty()) return {};
  return writePictures(all, options.output, map, light, texels);
}

Status readPatches(Inspected& all, const std::string& folder) {
  for (const lightmap::PatchEntry& entry : all.manifest.patches) {
    LUCERNA_TRY(bytes, lightmap::readEntry(folder, entry.patch));
    const std::string name = (fs::path(folder) / entry.patch.file).string();
    LUCERNA_TRY(patch, lightmap::patchFrom(bytes, name));
    if (patch.side != all.manifest.side || patch.maps != all.layout.maps)
      return error(ErrorKind::Input,
                   "{}: is of {} maps of {} texels a side, wanted {} of {} as the manifest says; "
                   "bake the scene again",
                   name, patch.maps, patch.side, all.layout.maps, all.manifest.side);
    all.patches.push_back(std::move(patch));
  }
  return {};
}

Status readScene(Inspected& all, const Options& options) {
  float exposure = options.exposure.value_or(0.f);
  if (!options.scene.empty()) {
    LUCERNA_TRY(scene, scene::loadScene(options.scene));
    scene::animate(scene, 0.f);
    LUCERNA_TRY_VOID(lightmap::checkFits(all.layout, scene));
    all.densities = lightmap::densities(all.layout, scene);
    exposure = options.exposure.value_or(scene.exposure);
  }
  all.factor = std::exp2(exposure);
  return {};
}

Json describe(const MapTable& map) {
  Json json{{"file", map.file},
            {"texels", map.texels},
            {"used", map.used},
            {"overlaps", map.overlaps},
            {"unsound", map.unsound},
            {"irradiance", {{"min", map.least}, {"mean", map.mean}, {"max", map.most}}},
            {"bytes", map.bytes}};
  if (map.mostDensity > 0.) json["density"] = {{"min", map.leastDensity}, {"max", map.mostDensity}};
  return json;
}

Json describe(const Inspected& all) {
  Json json{
      {"scene", all.manifest.scene}, {"side", all.manifest.side}, {"density", all.manifest.density},
      {"charts", all.layout.charts}, {"maps", Json::array()},     {"patches", Json::array()},
      {"files", all.files}};
  for (const MapTable& map : all.maps) json["maps"].push_back(describe(map));
  for (const lightmap::PatchEntry& patch : all.manifest.patches)
    json["patches"].push_back({{"group", patch.group},
                               {"form", patch.form},
                               {"file", patch.patch.file},
                               {"bytes", patch.bytes}});
  return json;
}

std::string textOf(const Inspected& all) {
  const bool dense = !all.densities.empty();
  std::string text = fmt::format("{:<16}{:>7}{:>11}{:>11}{:>11}{:>12}{}\n", "map", "used", "least",
                                 "mean", "most", "bytes", dense ? "   texels/m" : "");
  std::uint64_t overlaps = 0, unsound = 0;
  for (const MapTable& map : all.maps) {
    text += fmt::format("{:<16}{:>5.1f} %{:>11.4g}{:>11.4g}{:>11.4g}{:>12}", map.file,
                        100. * map.used, map.least, map.mean, map.most, map.bytes);
    if (dense) text += fmt::format("   {:.3g} to {:.3g}", map.leastDensity, map.mostDensity);
    text += '\n';
    overlaps += map.overlaps;
    unsound += map.unsound;
  }
  for (const lightmap::PatchEntry& patch : all.manifest.patches)
    text += fmt::format("group '{}': {}, {} of {} bytes\n", patch.group, patch.patch.file,
                        patch.form, patch.bytes);
  return text + fmt::format(
                    "{} charts; {} texels are shared by two; {} values are negative or no "
                    "numbers\n",
                    all.layout.charts, overlaps, unsound);
}

Status makeFolder(const std::string& folder) {
  std::error_code failed;
  if (folder.empty() || fs::is_directory(folder, failed)) return {};
  fs::create_directories(folder, failed);
  if (failed)
    return error(ErrorKind::Failed, "-o: the folder '{}' cannot be made ({})", folder,
                 failed.message());
  return {};
}

Result<int> inspect(const Options& options, bool json) {
  setThreadCount(options.threads);
  Inspected all;
  LUCERNA_TRY(manifest, lightmap::readManifest(options.folder));
  all.manifest = std::move(manifest);
  LUCERNA_TRY(layout, lightmap::readLayout(options.folder, all.manifest));
  all.layout = std::move(layout);
  LUCERNA_TRY_VOID(readPatches(all, options.folder));
  LUCERNA_TRY_VOID(lightmap::checkEntries(options.folder, all.manifest.gltf));
  LUCERNA_TRY_VOID(readScene(all, options));
  LUCERNA_TRY_VOID(makeFolder(options.output));
  Progress progress("looking at maps", all.manifest.maps.size());
  for (std::size_t i = 0; i < all.manifest.maps.size(); ++i) {
    if (Progress::cancelled()) return error(ErrorKind::Cancelled, "cancelled");
    LUCERNA_TRY_VOID(inspectMap(all, options, i));
    progress.advance();
  }
  if (json)
    printJson(describe(all));
  else
    printText(textOf(all));
  if (!all.files.empty()) log::info("wrote {} pictures to {}", all.files.size(), options.output);
  return 0;
}

CLI::App* addFolderCommand(CommandLine& line, CLI::App& group, const char* name, const char* help,
                           Result<int> (*run)(const Options&, bool),
                           const std::shared_ptr<Options>& options) {
  CLI::App* command = addCommand(line, group, name, help,
                                 [&line, options, run] { return run(*options, line.talk.json); });
  command->add_option("DIR", options->folder, "folder of a lightmap")->required();
  command->add_option("--threads", options->threads, "CPU threads; 0: one a core (0)")
      ->check(wholeNumber(0, 1024));
  return command;
}

}  // namespace

void addLightmap(CommandLine& line) {
  CLI::App* group = line.app.add_subcommand("lightmap", "join parts of a bake, or look at one");
  const auto merging = std::make_shared<Options>(), looking = std::make_shared<Options>();
  addFolderCommand(line, *group, "merge", "make the maps of what shards have baked", mergeOrCancel,
                   merging)
      ->add_option("--scene", merging->scene, "where the scene is now (where the shards found it)");
  CLI::App* command = addFolderCommand(
      line, *group, "inspect", "a table of the maps, and pictures of them", inspect, looking);
  command->add_option("-o,--output", looking->output,
                      "folder for pictures: light, charts and more");
  command->add_option("--scene", looking->scene, "for texels a metre, and the scene's exposure");
  command
      ->add_option_function<float>(
          "--exposure", [looking](float value) { looking->exposure = value; },
          "EV of the pictures of light (the scene's, or 0)")
      ->check(between(-32, 32, "EV"));
}

}  // namespace lucerna::cli
