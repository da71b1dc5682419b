#include "bake/own_files.hpp"

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "bake/folder_lock.hpp"
#include "bake/shards.hpp"
#include "bake/write_lightmap.hpp"
#include "core/file.hpp"
#include "core/json_value.hpp"
#include "lightmap/lightmap.hpp"

namespace lucerna::bake {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using Names = std::set<std::string>;

constexpr const char* kFormat = "unfinished/1";

// Takes digits off its start: their number.
std::size_t skipDigits(std::string_view& text) {
  const std::size_t digits = std::min(text.find_first_not_of("0123456789"), text.size());
  text.remove_prefix(digits);
  return digits;
}

bool skip(std::string_view& text, std::string_view start) {
  if (!text.starts_with(start)) return false;
  text.remove_prefix(start.size());
  return true;
}

// What the writers of core/file.hpp call a file until it is whole: the name that it is to have.
std::optional<std::string> targetOf(const std::string& name) {
  constexpr std::string_view kMark = ".tmp-";
  const std::size_t mark = name.rfind(kMark);
  if (!name.starts_with('.') || mark == std::string::npos || mark < 2) return {};
  std::string_view rest = std::string_view(name).substr(mark + kMark.size());
  if (skipDigits(rest) == 0 || !skip(rest, "-") || skipDigits(rest) == 0) return {};
  return name.substr(1, mark - 1) + std::string(rest);
}

bool isTemporary(const std::string& name) {
  const std::optional<std::string> target = targetOf(name);
  return target && (isLightmapFile(*target) || *target == kUnfinishedFile);
}

bool isOrder(const std::string& name) {
  return name == orderPath({}).filename();
}

// bake.json, its lock, and the logs of shards.
bool isWorkFile(const std::string& name) {
  std::string_view rest = name;
  const bool isLog = skip(rest, "shard-") && skipDigits(rest) > 0 && skip(rest, "-of-") &&
                     skipDigits(rest) > 0 && rest == ".log";
  const std::optional<std::string> target = targetOf(name);
  return isLog || isOrder(name) || name == kLockFile || (target && isOrder(*target));
}

bool isFile(const fs::path& path) {
  std::error_code none;
  return fs::is_regular_file(path, none);
}

bool isThere(const fs::path& path) {
  std::error_code none;
  return fs::exists(fs::symlink_status(path, none));
}

std::vector<fs::path> filesIn(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder, none)) files.push_back(entry.path());
  std::ranges::sort(files);
  return files;
}

// Whether a manifest that is damaged says that it is a lightmap's; such a file begins so.
bool saysLightmap(const fs::path& manifest) {
  std::string start(64, '\0');
  std::ifstream(manifest, std::ios::binary).read(start.data(), std::ssize(start));
  return start.find("\"lightmap/") != std::string::npos;
}

Result<Names> readList(const fs::path& path) {
  LUCERNA_TRY(text, readText(path));
  LUCERNA_TRY(document, JsonDocument::parse(text, path.string(), ErrorKind::Input));
  Names names;
  const JsonValue root = document.root();
  if (root.object({"lucerna", "files"})) {
    root.format(kFormat);
    root.require({"lucerna", "files"});
    if (root.has("files"))
      for (const JsonValue& file : root.at("files").elements())
        if (std::string name; file.text(name) && isLightmapFile(name)) names.insert(name);
  }
  LUCERNA_TRY_VOID(document.status());
  return names;
}

// What a bake has written there, or may have. Absent: no bake is there.
using Claimed = std::optional<Names>;

Names namesOf(const lightmap::Manifest& manifest) {
  Names names{kManifestFile};
  for (const lightmap::FileEntry& entry : lightmap::filesOf(manifest)) names.insert(entry.file);
  return names;
}

Status noneOfALightmap(const fs::path& folder, const std::string& name, std::string_view wanted) {
  return error(ErrorKind::Usage, "'{}' holds files that are none of a lightmap, as '{}'; {}",
               folder.string(), name, wanted);
}

constexpr const char* kWantedEmpty = "wanted a new or empty folder";

Result<Claimed> claimedIn(const fs::path& folder) {
  Claimed claimed;
  if (isThere(orderPath(folder))) claimed.emplace();
  if (isThere(folder / kUnfinishedFile)) {
    auto listed = readList(folder / kUnfinishedFile);
    if (!listed)
      return error(ErrorKind::Usage,
                   "{}; only it says which files in '{}' a bake that was stopped has made: remove "
                   "it and those that you do not need, or name another folder",
                   listed.error().message, folder.string());
    claimed = std::move(*listed);
  }
  if (!isThere(folder / kManifestFile)) return claimed;
  const auto manifest = lightmap::readManifest(folder);
  if (!manifest && !saysLightmap(folder / kManifestFile))
    return noneOfALightmap(folder, kManifestFile, kWantedEmpty).error();
  if (manifest) {
    if (!claimed) claimed.emplace();
    for (const std::string& name : namesOf(*manifest))
      if (isLightmapFile(name)) claimed->insert(name);
  } else if (!claimed || !claimed->contains(kManifestFile)) {
    return error(ErrorKind::Usage,
                 "{}; only it says which files in '{}' are the lightmap's: remove those that you "
                 "do not need, or name another folder",
                 lightmap::faultOf(manifest.error()), folder.string());
  }
  return claimed;
}

// What is gone by now was of a process beside this one.
Status checkWork(const fs::path& folder) {
  for (const fs::path& path : filesIn(folder / kWorkFolder))
    if (!(isWorkFile(path.filename().string()) && isFile(path)) && isThere(path))
      return noneOfALightmap(folder, path.lexically_relative(folder).string(),
                             "that folder is for what a bake has not finished: move it elsewhere, "
                             "or name another folder");
  return {};
}

Status checkOthersThan(const Claimed& claimed, const fs::path& folder) {
  LUCERNA_TRY_VOID(checkWork(folder));
  for (const fs::path& path : filesIn(folder)) {
    const std::string name = path.filename().string();
    if (name == kWorkFolder || name == kUnfinishedFile || isTemporary(name)) continue;
    const bool isOwn =
        claimed && (!isLightmapFile(name) || (claimed->contains(name) && isFile(path)));
    if (isOwn || !isThere(path)) continue;
    if (!claimed) return noneOfALightmap(folder, name, kWantedEmpty);
    return noneOfALightmap(folder, name,
                           "it is named like a lightmap's file, but no bake there has made it: "
                           "move it elsewhere, or name another folder");
  }
  return {};
}

// All that a bake may write; of pictures, which the glTF copy counts, the most that there can be.
Names namesOf(const Plan& plan) {
  Names names{kManifestFile, kLayoutFile, "scene.gltf", "scene.bin"};
  for (int i = 0; i < plan.packed.packing.maps; ++i)
    for (const char* end : {"exr", "hdr", "png", "rgb9e5.ktx2", "bc6h.ktx2"})
      names.insert(fmt::format("map-{:03}.{}", i, end));
  for (std::size_t i = 1; i < plan.groups.size(); ++i)
    names.insert(fmt::format("patch-{:03}.bin", i - 1));
  for (std::size_t i = 0; i < 2 * plan.world.scene->textures.size(); ++i)
    names.insert(fmt::format("tex-{:03}.png", i));
  return names;
}

}  // namespace

bool isLightmapFile(const std::string& name) {
  // Its start, three digits or more, and how it ends.
  const auto isNumbered = [&](std::string_view start,
                              std::initializer_list<std::string_view> ends) {
    std::string_view rest = name;
    return skip(rest, start) && skipDigits(rest) >= 3 &&
           std::ranges::find(ends, rest) != ends.end();
  };
  return name == kManifestFile || name == kLayoutFile || name == "scene.gltf" ||
         name == "scene.bin" || isNumbered("patch-", {".bin"}) || isNumbered("tex-", {".png"}) ||
         isNumbered("map-", {".exr", ".hdr", ".png", ".rgb9e5.ktx2", ".bc6h.ktx2"});
}

Status checkNoOthers(const fs::path& folder) {
  LUCERNA_TRY(claimed, claimedIn(folder));
  return checkOthersThan(claimed, folder);
}

Status claimFiles(const Plan& plan, const fs::path& folder) {
  LUCERNA_TRY(claimed, claimedIn(folder));
  LUCERNA_TRY_VOID(checkOthersThan(claimed, folder));
  Names names = namesOf(plan);
  if (claimed) names.merge(*claimed);
  const Json document{{"lucerna", kFormat}, {"files", names}};
  return writeText(folder / kUnfinishedFile, document.dump(1) + "\n");
}

Error orStopped(const Error& found, const fs::path& folder) {
  if (found.kind != ErrorKind::Input || !isThere(folder / kUnfinishedFile)) return found;
  return error(ErrorKind::Input,
               "{}; a bake that writes into '{}' was stopped, or is still at it: `lucerna bake ... "
               "-o {} --resume` goes on",
               lightmap::faultOf(found), folder.string(), folder.string());
}

void removeUnnamed(const fs::path& folder, const lightmap::Manifest& manifest) {
  const Result<Names> listed = readList(folder / kUnfinishedFile);
  if (!listed) return;
  const Names named = namesOf(manifest);
  std::error_code ignored;
  for (const std::string& name : *listed)
    if (!named.contains(name) && isFile(folder / name)) fs::remove(folder / name, ignored);
  fs::remove(folder / kUnfinishedFile, ignored);
}

void removeWork(const fs::path& folder) {
  std::error_code ignored;
  if (isThere(folder / kUnfinishedFile))
    if (const auto manifest = lightmap::readManifest(folder)) removeUnnamed(folder, *manifest);
  // First what says that there is work to go on with.
  fs::remove(orderPath(folder), ignored);
  for (const fs::path& path : filesIn(folder / kWorkFolder))
    if (const std::string name = path.filename().string();
        isWorkFile(name) && name != kLockFile && isFile(path))
      fs::remove(path, ignored);
  fs::remove(folder / kWorkFolder, ignored);  // only if it is empty
  for (const fs::path& path : filesIn(folder))
    if (isTemporary(path.filename().string()) && isFile(path)) fs::remove(path, ignored);
}

}  // namespace lucerna::bake
