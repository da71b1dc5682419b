// Draws the scene's background as a view sees it: behind what a pass has drawn, or under what it is
// going to draw.
#pragma once

#include "render/gpu_scene.hpp"
#include "render/view_data.hpp"

namespace lucerna::render {

class BackgroundShading {
 public:
  explicit BackgroundShading(gpu::Device& device);

  // A triangle over the viewport, at the far plane. intensity: factor on the background's radiance.
  void draw(gpu::Rendering& rendering, const GpuScene& scene, const ViewData& view, float intensity,
            const gpu::RenderState& state);

 private:
  gpu::ProgramPtr color_, image_, cubeMap_;
};

}  // namespace lucerna::render
