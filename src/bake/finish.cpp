// The last stage: logs into maps, seams closed, files written. What switches goes through some
// groups at a time: memory does not grow with their number.
#include <algorithm>

#include "bake/assemble.hpp"
#include "bake/bake.hpp"
#include "bake/cancelled.hpp"
#include "bake/own_files.hpp"
#include "bake/seams.hpp"
#include "bake/seconds.hpp"
#include "bake/unit_log.hpp"
#include "bake/write_lightmap.hpp"

namespace lucerna::bake {
namespace {

namespace fs = std::filesystem;

// What all logs in DIR/work hold.
struct Logs {
  std::vector<fs::path> paths;
  std::vector<std::uint64_t> lit;  // texels of each group, some of them dark
};

Status checkComplete(const fs::path& folder, const std::vector<fs::path>& logs,
                     const std::vector<bool>& done, const std::vector<std::string>& damaged) {
  const auto missing = std::ranges::count(done, false);
  if (missing == 0) return {};
  const std::string damage = damaged.empty() ? "" : fmt::format("; {}", fmt::join(damaged, "; "));
  return error(ErrorKind::Failed,
               "'{}': {} of {} units of light are missing: {}{}; bake these shards with the same "
               "settings and --resume",
               folder.string(), missing, done.size(), describeMissing(logs, done), damage);
}

// Puts these groups' light of every unit into `baked`. progress: counts units, if it is given.
Result<Logs> readLogs(const Plan& plan, const fs::path& folder, const GroupRange& groups,
                      BakedLight& baked, Progress* progress = nullptr) {
  Logs logs{.paths = logsIn(folder), .lit = std::vector<std::uint64_t>(plan.groups.size(), 0)};
  std::vector<bool> done(plan.units.size(), false);
  std::vector<std::string> damage;
  for (const fs::path& path : logs.paths) {
    const auto use = [&](std::uint32_t unit, std::span<const std::byte> payload) -> Status {
      LUCERNA_TRY_VOID(checkGoesOn());
      if (done[unit]) return {};
      const auto light = unitLightFrom(payload, plan, plan.units[unit]);
      if (!light)
        return error(ErrorKind::Input, "{}: is damaged; remove it and bake that part again",
                     path.string());
      putInMaps(baked, plan, plan.units[unit], *light, groups);
      for (const BlockLight& block : light->blocks)
        for (const GroupLight& group : block.groups) logs.lit[group.group] += group.rgb.size() / 3;
      done[unit] = true;
      if (progress) progress->advance();
      return {};
    };
    LUCERNA_TRY(state, readUnitLog(path, logHash(plan), plan.units.size(), use));
    damage.insert(damage.end(), state.damage.begin(), state.damage.end());
  }
  LUCERNA_TRY_VOID(checkComplete(folder, logs.paths, done, damage));
  return logs;
}

Result<Logs> readAlwaysOn(const Plan& plan, const fs::path& folder, BakedLight& baked) {
  Progress progress("reading logs", plan.units.size());
  return readLogs(plan, folder, {.first = 0, .last = 1}, baked, &progress);
}

// The next groups that are finished together, from `first` on: at least one.
GroupRange nextGroups(const std::vector<std::uint64_t>& lit, std::uint32_t first,
                      std::uint64_t mostBytes) {
  GroupRange range{.first = first, .last = first};
  for (std::uint64_t bytes = 0; range.last < lit.size(); ++range.last) {
    bytes += kLitBytes * lit[range.last] + kGroupBytes;
    if (bytes > mostBytes && range.last > first) break;
  }
  return range;
}

// All that switches, some groups at a time.
Status finishGroups(const Plan& plan, const fs::path& folder, const Logs& logs, BakedLight& baked,
                    Seams& seams, LightmapWriter& writer) {
  const auto count = static_cast<std::uint32_t>(plan.groups.size());
  if (count < 2) return {};
  Progress progress("making patches", count - 1);
  for (GroupRange groups{.first = 1, .last = 1}; groups.last < count;) {
    groups = nextGroups(logs.lit, groups.last, mostGroupBytes(plan));
    LUCERNA_TRY_VOID(readLogs(plan, folder, groups, baked));
    dilate(baked);
    seams.close(baked);
    LUCERNA_TRY_VOID(checkGoesOn());
    LUCERNA_TRY_VOID(writer.writePatches(baked, groups, progress));
    for (lightmap::HalfTiles& group : baked.groups) group = lightmap::HalfTiles(3);
  }
  return {};
}

}  // namespace

Status finish(const Plan& plan, const fs::path& folder, BakeReport& report) {
  const auto start = Clock::now();
  BakedLight baked = emptyLight(plan);
  LUCERNA_TRY(logs, readAlwaysOn(plan, folder, baked));
  dilate(baked);
  LUCERNA_TRY_VOID(checkGoesOn());
  Seams seams(plan, baked.texels);
  seams.close(baked);
  LUCERNA_TRY_VOID(checkGoesOn());
  LUCERNA_TRY(writer, LightmapWriter::begin(plan, folder));
  LUCERNA_TRY_VOID(writer.writeMaps(baked.maps, baked.texels));
  baked.maps = {};
  LUCERNA_TRY_VOID(finishGroups(plan, folder, logs, baked, seams, writer));
  report.seams = seams.report();
  LUCERNA_TRY_VOID(writer.end());
  report.texels = writer.texels();
  removeWork(folder);
  report.seconds.finish += secondsSince(start);
  return {};
}

}  // namespace lucerna::bake
