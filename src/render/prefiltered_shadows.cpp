#include "render/prefiltered_shadows.hpp"

namespace lucerna::render {

void bindPrefilteredShadows(gpu::Commands& commands, const PrefilteredShadows& shadows) {
  const gpu::Sampler sampler{.filter =
                                 shadows.levels ? gpu::Filter::Trilinear : gpu::Filter::Linear};
  commands.texture("directionalMoments", shadows.directional, sampler);
  commands.texture("localMoments", shadows.local, sampler);
}

}  // namespace lucerna::render
