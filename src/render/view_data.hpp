// The resource "view": where this picture is seen from, on the CPU and as the uniform block
// `ViewBlock` (render/view.glsl).
#pragma once

#include "gpu/device.hpp"
#include "scene/view.hpp"

namespace lucerna::render {

struct ViewData {
  static constexpr const char* kPortName = "View";
  scene::View view;
  uvec2 size{0};      // pixels of the rendering
  gpu::Buffer block;  // ViewBlock
};

// Fills `data` for a view of the given size; reuses its buffer.
void updateView(gpu::Device& device, ViewData& data, const scene::View& view, uvec2 size);

}  // namespace lucerna::render
