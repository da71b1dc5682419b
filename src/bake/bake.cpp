#include "bake/bake.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <mutex>

#include "bake/assemble.hpp"
#include "bake/unit_log.hpp"
#include "bake/write_lightmap.hpp"
#include "core/parallel.hpp"
#include "core/progress.hpp"

namespace lucerna::bake {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr const char* kWork = "work";

double secondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

fs::path logPath(const fs::path& folder, const Shard& shard) {
  return folder / kWork / fmt::format("shard-{}-of-{}.log", shard.index, shard.count);
}

std::vector<std::uint32_t> unitsOf(const Plan& plan, const Shard& shard) {
  std::vector<std::uint32_t> units;
  for (auto i = static_cast<std::uint32_t>(shard.index - 1); i < plan.units.size();
       i += static_cast<std::uint32_t>(shard.count))
    units.push_back(i);
  return units;
}

std::vector<fs::path> logsIn(const fs::path& folder) {
  std::vector<fs::path> logs;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder / kWork, none))
    if (entry.path().extension() == ".log") logs.push_back(entry.path());
  std::ranges::sort(logs);
  return logs;
}

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

}  // namespace

Status prepareFolder(const fs::path& folder, bool resume, const Shard& shard) {
  std::error_code failed;
  const fs::path work = folder / kWork;
  if (fs::exists(folder, failed) && !fs::is_directory(folder, failed))
    return error(ErrorKind::Usage, "-o: '{}' is a file; wanted a folder", folder.string());
  if (fs::exists(logPath(folder, shard), failed) && !resume)
    return error(ErrorKind::Usage,
                 "-o: '{}' holds an unfinished bake; go on with --resume, or remove '{}'",
                 folder.string(), work.string());
  const bool foreign = fs::is_directory(folder, failed) && !fs::is_empty(folder, failed) &&
                       !fs::exists(folder / "manifest.json", failed) && !fs::exists(work, failed);
  if (foreign)
    return error(ErrorKind::Usage,
                 "-o: '{}' holds files that are none of a lightmap; wanted a new or empty folder",
                 folder.string());
  fs::create_directories(work, failed);
  if (failed)
    return error(ErrorKind::Failed, "-o: '{}' cannot be made ({})", work.string(),
                 failed.message());
  return {};
}

Status lightShard(const Plan& plan, const fs::path& folder, const Shard& shard,
                  BakeReport& report) {
  LUCERNA_TRY(log, UnitLog::open(logPath(folder, shard), plan.hash, plan.units.size()));
  report.warnings.insert(report.warnings.end(), log.state().warnings.begin(),
                         log.state().warnings.end());
  std::vector<std::uint32_t> missing = unitsOf(plan, shard);
  report.units = missing.size();
  std::erase_if(missing, [&](std::uint32_t unit) { return log.state().done[unit]; });
  report.unitsBefore = report.units - missing.size();
  if (missing.empty()) return {};

  const auto start = Clock::now();
  const LightScene scene(plan);
  report.seconds.prepare += secondsSince(start);
  const auto lit = Clock::now();
  std::uint64_t texels = 0;
  for (const std::uint32_t unit : missing) texels += plan.units[unit].texels;
  Progress progress("lighting", texels);
  FirstError failure;
  std::mutex counting;
  constexpr std::size_t kGrain = 4;  // units that share what a thread makes first
  parallelFor(missing.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    UnitLighter lighter(plan, scene);
    for (std::size_t i = begin; i < end; ++i) {
      if (Progress::cancelled() || failure.any()) break;
      const Unit& unit = plan.units[missing[i]];
      if (Status kept = log.append(missing[i], toBytes(lighter.light(unit))); !kept)
        failure.set(kept.error());
      progress.advance(unit.texels);
    }
    const std::scoped_lock lock(counting);
    report.counters.add(lighter.counters());
    report.samplingSeconds += lighter.samplingSeconds;
  });
  report.seconds.light += secondsSince(lit);
  LUCERNA_TRY_VOID(failure.status());
  if (Progress::cancelled())
    return error(ErrorKind::Cancelled, "cancelled; what is finished is kept, go on with --resume");
  return {};
}

Status finish(const Plan& plan, const fs::path& folder, BakeReport& report) {
  const auto start = Clock::now();
  BakedLight baked = emptyLight(plan);
  std::vector<bool> done(plan.units.size(), false);
  std::vector<std::string> sources;
  for (const fs::path& path : logsIn(folder)) {
    const auto use = [&](std::uint32_t unit, std::span<const std::byte> payload) -> Status {
      if (done[unit]) return {};
      const auto light = unitLightFrom(payload, plan, plan.units[unit]);
      if (!light)
        return error(ErrorKind::Input, "{}: is damaged; remove it and bake that part again",
                     path.string());
      place(baked, plan, plan.units[unit], *light);
      done[unit] = true;
      return {};
    };
    LUCERNA_TRY(state, readUnitLog(path, plan.hash, plan.units.size(), use));
    report.warnings.insert(report.warnings.end(), state.warnings.begin(), state.warnings.end());
    sources.push_back(path.filename().string());
  }
  const auto missing = std::ranges::count(done, false);
  if (missing > 0)
    return error(ErrorKind::Failed,
                 "'{}': {} of {} units of light are missing; found {}; bake the shards that are "
                 "missing, or those again that were not finished, with --resume",
                 folder.string(), missing, done.size(),
                 sources.empty() ? "no logs" : fmt::format("{}", fmt::join(sources, ", ")));
  dilate(baked);
  report.seams = closeSeams(plan, baked);
  LUCERNA_TRY_VOID(writeLightmap(plan, baked, folder, report.texels));
  std::error_code ignored;
  fs::remove_all(folder / kWork, ignored);
  report.seconds.finish += secondsSince(start);
  return {};
}

}  // namespace lucerna::bake
