// What `lucerna bake` says of what it is asked for and of what it did: as JSON, and on stderr.
#pragma once

#include <string>

#include "bake/bake.hpp"
#include "bake/estimate.hpp"
#include "bake/preflight.hpp"
#include "command_line.hpp"

namespace lucerna::cli {

Json describe(const bake::Plan& plan);
Json describe(const bake::BakeReport& report);
Json describe(const bake::Preflight& found);
Json describe(const bake::Estimate& estimate);

void sayPlan(const bake::Plan& plan);
void sayReport(const bake::BakeReport& report);

// What --dry-run prints.
std::string estimateText(const bake::Plan& plan, const bake::Estimate& estimate);

}  // namespace lucerna::cli
