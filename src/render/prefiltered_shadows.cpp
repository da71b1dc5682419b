#include "render/prefiltered_shadows.hpp"

namespace lucerna::render {

void bindPrefilteredShadows(gpu::Commands& commands, const PrefilteredShadows& shadows) {
  commands.texture("directionalMoments", shadows.directional, gpu::kLinear);
  commands.texture("localMoments", shadows.local, gpu::kLinear);
}

}  // namespace lucerna::render
