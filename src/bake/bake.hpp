// A bake from a plan to files: light into logs, logs into maps. A shard does the first, merging the
// second; a plain bake is the only shard and merges at once.
//
// While it runs, DIR/work holds what is finished. A finished DIR has the maps and what
// manifest.json names, and nothing else.
#pragma once

#include <filesystem>

#include "bake/plan.hpp"
#include "bake/seams.hpp"
#include "bake/unit_light.hpp"

namespace lucerna::bake {

struct Shard {
  int index = 1, count = 1;  // from 1
};

struct StageSeconds {
  double prepare = 0., light = 0., finish = 0.;  // of the clock on the wall
};

struct BakeReport {
  StageSeconds seconds;
  LightCounters counters;                    // of this run
  double samplingSeconds = 0.;               // of all threads
  std::uint64_t units = 0, unitsBefore = 0;  // of this shard; those that a log had already
  std::uint64_t texels = 0;                  // that lie on the scene
  SeamReport seams;
  std::vector<std::string> warnings;
};

// Makes DIR and DIR/work. ErrorKind::Usage: DIR/work holds an unfinished bake and `resume` is not
// set; DIR is not empty and holds no lightmap.
Status prepareFolder(const std::filesystem::path& folder, bool resume, const Shard& shard);

// Lights the shard's units that no log of it has yet, and logs them. ErrorKind::Cancelled after
// Ctrl-C: what is done is kept.
Status lightShard(const Plan& plan, const std::filesystem::path& folder, const Shard& shard,
                  BakeReport& report);

// Reads all logs in DIR/work and writes maps, layout and manifest; then DIR/work is removed.
// ErrorKind::Failed: units are missing (it says of which shards).
Status finish(const Plan& plan, const std::filesystem::path& folder, BakeReport& report);

}  // namespace lucerna::bake
