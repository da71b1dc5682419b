#include "bake/bake.hpp"

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <mutex>

#include "bake/bake_order.hpp"
#include "bake/cancelled.hpp"
#include "bake/own_files.hpp"
#include "bake/seconds.hpp"
#include "bake/shadow_tracer.hpp"
#include "bake/unit_log.hpp"
#include "bake/write_lightmap.hpp"
#include "core/hash.hpp"
#include "core/parallel.hpp"
#include "lightmap/lightmap.hpp"

namespace lucerna::bake {
namespace {

namespace fs = std::filesystem;

// The first error of any thread; the others stop.
class FirstError {
 public:
  void set(Error found) {
    const std::scoped_lock lock(mutex_);
    if (!error_) error_ = std::move(found);
    any_ = true;
  }
  bool any() const { return any_; }
  Status status() const { return error_ ? Status(*error_) : Status(); }

 private:
  std::mutex mutex_;
  std::atomic<bool> any_{false};
  std::optional<Error> error_;
};

// The nearest folder on the way there that exists can be written.
Status checkWritable(const fs::path& folder) {
  std::error_code failed;
  fs::path there = fs::absolute(folder, failed);
  while (!fs::exists(there, failed) && there.has_relative_path()) there = there.parent_path();
  if (::access(there.c_str(), W_OK | X_OK) == 0 && fs::is_directory(there, failed)) return {};
  return error(ErrorKind::Failed, "-o: '{}' cannot be made: '{}' is no folder that can be written",
               folder.string(), there.string());
}

// Marks what logs of other divisions into shards hold: no shard of this one writes them.
Status addDoneElsewhere(const Plan& plan, const fs::path& folder, const Shard& shard,
                        std::vector<bool>& done) {
  const std::string ending = fmt::format("-of-{}.log", shard.count);
  for (const fs::path& log : logsIn(folder)) {
    if (log.filename().string().ends_with(ending)) continue;
    LUCERNA_TRY(state, readUnitLog(log, logHash(plan), plan.units.size(), {}));
    for (std::size_t i = 0; i < done.size(); ++i)
      if (state.done[i]) done[i] = true;
  }
  return {};
}

}  // namespace

Status checkIsApart(const fs::path& folder, const std::string& scene) {
  std::error_code missing;
  if (scene.starts_with("builtin:") ||
      !fs::equivalent(fs::absolute(scene, missing).parent_path(), folder, missing))
    return {};
  return error(ErrorKind::Usage,
               "-o: '{}' is the folder of the scene '{}', and a lightmap's files could replace the "
               "scene's; wanted a folder of its own, as '{}'",
               folder.string(), scene, (folder / "bake").string());
}

Status checkFolder(const fs::path& folder, bool resume, const Shard& shard) {
  std::error_code failed;
  if (fs::exists(folder, failed) && !fs::is_directory(folder, failed))
    return error(ErrorKind::Usage, "-o: '{}' is a file; wanted a folder", folder.string());
  if (fs::exists(logPath(folder, shard), failed) && !resume)
    return error(ErrorKind::Usage,
                 "-o: '{}' holds an unfinished bake; go on with --resume, or remove '{}'",
                 folder.string(), (folder / kWorkFolder).string());
  if (const Status others = checkNoOthers(folder); !others)
    return error(others.error().kind, "-o: {}", others.error().message);
  return checkWritable(folder);
}

Result<FolderLock> prepareFolder(const fs::path& folder, bool resume, const Shard& shard) {
  LUCERNA_TRY_VOID(checkFolder(folder, resume, shard));
  std::error_code failed;
  fs::create_directories(folder / kWorkFolder, failed);
  if (failed)
    return error(ErrorKind::Failed, "-o: '{}' cannot be made ({})", (folder / kWorkFolder).string(),
                 failed.message());
  return FolderLock::take(folder, FolderLock::Use::Light);
}

namespace {

// What a finished bake differs in.
Error isAnother(const Plan& plan, const lightmap::Manifest& manifest, const fs::path& folder) {
  const auto there = settingsFrom(manifest.settings, "settings");
  const std::string found = there ? differences(*there, plan.settings) : "";
  const std::string& scene = plan.world.scene->name;
  std::string what = fmt::format(
      "'{}' as it was before it changed, or of another version of this program;", manifest.scene);
  if (!found.empty())
    what = "other settings: " + found + "; give the same, or";
  else if (manifest.scene != scene)
    what = fmt::format("another scene: '{}' there, '{}' here; give the same, or", manifest.scene,
                       scene);
  return error(ErrorKind::Usage,
               "-o: '{}' holds a finished bake of {} bake without --resume to replace it",
               folder.string(), what);
}

}  // namespace

Result<bool> isFinished(const Plan& plan, const fs::path& folder) {
  std::error_code none;
  if (!fs::exists(folder / kManifestFile, none)) return false;
  const auto manifest = lightmap::readManifest(folder);
  const bool unfinished = fs::exists(orderPath(folder), none);
  if (!manifest) {
    if (unfinished) return false;
    return manifest.error();
  }
  if (manifest->sceneHash != lightmap::hashText16(plan.hash) ||
      manifest->settings != settingsText(plan.settings)) {
    if (unfinished) return false;
    return isAnother(plan, *manifest, folder);
  }
  LUCERNA_TRY_VOID(lightmap::checkEntries(folder, lightmap::filesOf(*manifest)));
  return true;
}

bool isOwnWork(const Plan& plan, const fs::path& folder) {
  std::error_code none;
  if (fs::exists(orderPath(folder), none)) {
    const auto order = readOrder(folder);
    return order && order->plan == plan.hash;
  }
  // One that was killed while it removed them has left logs alone.
  return std::ranges::all_of(logsIn(folder), [&](const fs::path& log) {
    return static_cast<bool>(readUnitLog(log, logHash(plan), plan.units.size(), {}));
  });
}

Status lightShard(const Plan& plan, const fs::path& folder, const Shard& shard,
                  BakeReport& report) {
  LUCERNA_TRY(log, UnitLog::open(logPath(folder, shard), logHash(plan), plan.units.size()));
  for (const std::string& damage : log.state().damage)
    report.warnings.push_back(damage + "; what it held is baked again");
  std::vector<std::uint32_t> missing = unitsOf(plan.units.size(), shard);
  report.units = missing.size();
  std::vector<bool> done = log.state().done;
  LUCERNA_TRY_VOID(addDoneElsewhere(plan, folder, shard, done));
  std::erase_if(missing, [&](std::uint32_t unit) { return done[unit]; });
  report.unitsBefore = report.units - missing.size();
  if (missing.empty()) return {};

  const auto start = Clock::now();
  const LightScene scene(plan);
  LUCERNA_TRY_VOID(scene.emitters.status);
  report.seconds.prepare += secondsSince(start);
  const auto lit = Clock::now();
  std::uint64_t texels = 0;
  for (const std::uint32_t unit : missing) texels += plan.units[unit].texels;
  Progress progress("lighting", texels, "rays");
  FirstError failure;
  std::mutex counting;
  // Units that share what a thread makes first; one, where there are few for each thread.
  const std::size_t grain =
      std::clamp<std::size_t>(missing.size() / (8 * static_cast<std::size_t>(threadCount())), 1, 4);
  parallelFor(missing.size(), grain, [&](std::size_t begin, std::size_t end) {
    UnitLighter lighter(plan, scene);
    std::uint64_t rays = 0;
    for (std::size_t i = begin; i < end; ++i) {
      if (Progress::cancelled() || failure.any()) break;
      const Unit& unit = plan.units[missing[i]];
      if (Status kept = log.append(missing[i], toBytes(lighter.light(unit))); !kept)
        failure.set(kept.error());
      progress.advance(unit.texels,
                       lighter.counters().rays - std::exchange(rays, lighter.counters().rays));
    }
    const std::scoped_lock lock(counting);
    report.counters.add(lighter.counters());
    report.samplingSeconds += lighter.samplingSeconds;
  });
  report.seconds.light += secondsSince(lit);
  LUCERNA_TRY_VOID(failure.status());
  return checkGoesOn();
}

}  // namespace lucerna::bake
