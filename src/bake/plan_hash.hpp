// One number for everything that a bake's light depends on.
#pragma once

#include "bake/plan.hpp"

namespace lucerna::bake {

// Two plans of the same hash give the same units of light. The engine's threads and the number of
// shards are not in it.
std::uint64_t hashOf(const Plan& plan);

}  // namespace lucerna::bake
