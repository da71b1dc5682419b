// All passes that ship, and the resources they read.
#pragma once

#include "gpu/shader_source.hpp"
#include "graph/registry.hpp"

namespace lucerna::passes {

// Adds every pass and the resources "scene", "view" (per view) and "lights".
void registerPasses(graph::Registry& registry);

// Adds the shaders of render/ and passes/; call it before the first pass is made.
void registerShaders(gpu::ShaderSources& sources);

}  // namespace lucerna::passes
