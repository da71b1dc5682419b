// Who bakes which units of a plan, and the files in which shards leave them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bake/plan.hpp"

namespace lucerna::bake {

inline constexpr const char* kWorkFolder = "work";  // in DIR

struct Shard {
  int index = 1, count = 1;  // from 1
};

std::vector<std::uint32_t> unitsOf(std::size_t units, const Shard& shard);

// What logs are checked by: light of another kind of processor differs in the last bits.
std::uint64_t logHash(const Plan& plan);

std::filesystem::path orderPath(const std::filesystem::path& folder);  // bake/bake_order.hpp
std::filesystem::path logPath(const std::filesystem::path& folder, const Shard& shard);
// In the order of their names.
std::vector<std::filesystem::path> logsIn(const std::filesystem::path& folder);

// Which shards the units that are not done belong to: "shard 3 of 5 has no log; shard 2 of 5 lacks
// 17 of 80 units". Of how many shards, most of the logs' names say.
std::string describeMissing(const std::vector<std::filesystem::path>& logs,
                            const std::vector<bool>& done);

}  // namespace lucerna::bake
