// All passes that ship, and the resources they read.
#pragma once

#include "graph/registry.hpp"

namespace lucerna::passes {

// Adds every pass, the resources "scene", "view" (per view), "views", "lights" and "lightmaps", and
// the shaders of render/ and passes/.
void registerPasses(graph::Registry& registry);

}  // namespace lucerna::passes
