// A bake from a plan to files: light into logs, logs into maps. A shard does the first, merging the
// second; a plain bake is the only shard and merges at once.
//
// While it runs, DIR/work holds what is finished and what was asked for (bake/bake_order.hpp). A
// finished DIR has the maps and what manifest.json names, and nothing else of a bake's
// (bake/own_files.hpp).
#pragma once

#include <filesystem>

#include "bake/folder_lock.hpp"
#include "bake/plan.hpp"
#include "bake/seams.hpp"
#include "bake/shards.hpp"
#include "bake/unit_light.hpp"

namespace lucerna::bake {

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

// ErrorKind::Usage: DIR is the folder that the scene's file, if it is one, lies in.
Status checkIsApart(const std::filesystem::path& folder, const std::string& scene);

// Asks before long work. ErrorKind::Usage: DIR/work holds an unfinished part of the same number and
// `resume` is not set; DIR is a file, or holds what is in the way (checkNoOthers()).
// ErrorKind::Failed: it cannot be written.
Status checkFolder(const std::filesystem::path& folder, bool resume, const Shard& shard);
// The same, and makes DIR and DIR/work. Gives the lock under which a shard lights.
Result<FolderLock> prepareFolder(const std::filesystem::path& folder, bool resume,
                                 const Shard& shard);

// Whether DIR holds this very bake, finished: each of its files is read. ErrorKind::Input: it does,
// but a file is damaged; the message names it. ErrorKind::Usage: it holds another finished bake and
// no unfinished one.
Result<bool> isFinished(const Plan& plan, const std::filesystem::path& folder);

// Whether what DIR/work holds is of this very bake, if it holds anything.
bool isOwnWork(const Plan& plan, const std::filesystem::path& folder);

// Lights the shard's units that no log has yet, and logs them. ErrorKind::Cancelled after Ctrl-C:
// what is done is kept.
Status lightShard(const Plan& plan, const std::filesystem::path& folder, const Shard& shard,
                  BakeReport& report);

// Under a FolderLock that is for writing: reads all logs in DIR/work and writes maps, layout and
// manifest; then DIR/work is removed.
// ErrorKind::Cancelled after Ctrl-C: DIR/work is kept, and the manifest is not written.
// ErrorKind::Failed: units are missing (it says of which shards, and which logs are damaged where).
Status finish(const Plan& plan, const std::filesystem::path& folder, BakeReport& report);

}  // namespace lucerna::bake
