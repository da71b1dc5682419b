// What a bake will take, found out by baking a little of it.
#pragma once

#include <cstdint>

#include "bake/plan.hpp"
#include "core/result.hpp"

namespace lucerna::bake {

struct Estimate {
  std::uint64_t units = 0;         // lit for it, some in part
  std::uint64_t emitterCells = 0;  // of surfaces that shine
  double prepareSeconds = 0.;      // taken, before the first ray
  double lightSeconds = 0.;        // of this machine's threads as they are set
  double deviation = 0.;           // standard, of lightSeconds; 0 of a single unit
  // At once, while light is made: measured. While maps are made: measured up to the plan, and
  // counted for maps and groups. 0: this machine does not say.
  std::uint64_t lightBytes = 0, finishBytes = 0;
  std::uint64_t logBytes = 0;  // in DIR/work
  std::uint64_t litBytes = 0;  // of groups that switch, if all were in memory at once
};

// Lights units in a random order, the same each time, for about so many seconds, and a block at
// least; what they take goes by their texels. ErrorKind::Cancelled after Ctrl-C.
Result<Estimate> estimate(const Plan& plan, double seconds);

}  // namespace lucerna::bake
