// Fullscreen: a pass without C++. The row names a fragment shader; the shader's samplers are the
// row's ports and its uniforms the row's parameters.
#pragma once

#include <memory>

#include "gpu/shader_source.hpp"
#include "graph/pass.hpp"

namespace lucerna::passes {

// sources: those of the device that will draw.
std::unique_ptr<graph::PassType> fullscreenType(std::shared_ptr<gpu::ShaderSources> sources);

}  // namespace lucerna::passes
