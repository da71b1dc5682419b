#include "bake/shards.hpp"

#include <algorithm>
#include <cstdio>
#include <map>
#include <set>

#include "bake/shadow_tracer.hpp"
#include "core/hash.hpp"

namespace lucerna::bake {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostNamed = 20;

// The indices of the shards that have a log, by the number of shards.
std::map<int, std::set<int>> shardsOf(const std::vector<fs::path>& logs) {
  std::map<int, std::set<int>> found;
  for (const fs::path& log : logs) {
    Shard shard;
    if (std::sscanf(log.filename().c_str(), "shard-%d-of-%d.log", &shard.index, &shard.count) == 2)
      found[shard.count].insert(shard.index);
  }
  return found;
}

std::string describe(const Shard& shard, bool hasLog, const std::vector<bool>& done) {
  const std::vector<std::uint32_t> units = unitsOf(done.size(), shard);
  const auto missing =
      std::ranges::count_if(units, [&](std::uint32_t unit) { return !done[unit]; });
  if (missing == 0) return {};
  if (!hasLog) return fmt::format("shard {} of {} has no log", shard.index, shard.count);
  return fmt::format("shard {} of {} lacks {} of {} units", shard.index, shard.count, missing,
                     units.size());
}

}  // namespace

std::vector<std::uint32_t> unitsOf(std::size_t units, const Shard& shard) {
  std::vector<std::uint32_t> mine;
  for (auto i = static_cast<std::uint32_t>(shard.index - 1); i < units;
       i += static_cast<std::uint32_t>(shard.count))
    mine.push_back(i);
  return mine;
}

std::uint64_t logHash(const Plan& plan) {
  const std::string_view processor = rayInstructionSet();
  return hashCombine(plan.hash, hashBytes(std::as_bytes(std::span(processor))));
}

fs::path orderPath(const fs::path& folder) {
  return folder / kWorkFolder / "bake.json";
}

fs::path logPath(const fs::path& folder, const Shard& shard) {
  return folder / kWorkFolder / fmt::format("shard-{}-of-{}.log", shard.index, shard.count);
}

std::vector<fs::path> logsIn(const fs::path& folder) {
  std::vector<fs::path> logs;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder / kWorkFolder, none))
    if (entry.path().extension() == ".log") logs.push_back(entry.path());
  std::ranges::sort(logs);
  return logs;
}

std::string describeMissing(const std::vector<fs::path>& logs, const std::vector<bool>& done) {
  const std::map<int, std::set<int>> shards = shardsOf(logs);
  if (shards.empty()) return "there is no log of any shard";
  const auto& [count, found] =
      *std::ranges::max_element(shards, {}, [](const auto& s) { return s.second.size(); });
  std::vector<std::string> parts;
  for (int i = 1; i <= count; ++i)
    if (std::string part = describe({.index = i, .count = count}, found.contains(i), done);
        !part.empty())
      parts.push_back(std::move(part));
  if (parts.size() > kMostNamed) {
    const std::size_t more = parts.size() - kMostNamed;
    parts.resize(kMostNamed);
    parts.push_back(fmt::format("{} more shards", more));
  }
  return fmt::format("{}", fmt::join(parts, "; "));
}

}  // namespace lucerna::bake
