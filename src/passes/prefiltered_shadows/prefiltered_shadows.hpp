// PrefilteredShadows: moments of what shadow maps show, blurred once so that a lookup needs one
// tap.
#pragma once

#include <array>
#include <vector>

#include "graph/pass_info.hpp"
#include "render/prefiltered_shadows.hpp"
#include "render/shadow_maps.hpp"

namespace lucerna::passes {

class PrefilteredShadows {
 public:
  enum class Penumbra { Kernel, Light };
  enum class Resolution { Full, Half, Quarter };
  enum class Redraw { Changed, Always };
  struct Params {
    Penumbra penumbra = Penumbra::Light;
    int kernel = 5;  // texels of a shadow map, odd
    Resolution resolution = Resolution::Half;
    Redraw redraw = Redraw::Changed;
  };
  struct Ports {
    graph::In<render::ShadowMaps> shadowMaps;
    graph::Out<render::PrefilteredShadows> prefilteredShadows;
  };

  static void describe(graph::PassInfo<Params, Ports>& d);
  explicit PrefilteredShadows(gpu::Device& device);
  void execute(graph::PassContext& context, const Params& params, const Ports& ports);

 private:
  void prefilter(gpu::Device& device, const Params& params, const Ports& ports,
                 const render::ShadowMaps::Map& map);
  void makeMoments(gpu::Device& device, Resolution resolution, const gpu::Texture& maps,
                   const render::ShadowMaps::Map& map, const gpu::Rect& viewport);
  void blur(gpu::Device& device, const gpu::Texture& from, const gpu::Targets& to, ivec2 axis,
            const std::vector<float>& weights);
  void makeLevels(gpu::Device& device, const gpu::Texture& texture, int layer,
                  const gpu::Rect& rect);

  std::array<gpu::ProgramPtr, 3> moments_;  // for each Resolution
  gpu::ProgramPtr blur_, halve_;
  std::array<gpu::Texture, 2> between_;  // as large as the largest map's moments
};

}  // namespace lucerna::passes
