// The resource "view": where this picture is seen from, on the CPU and as the uniform block
// `ViewBlock` (render/view.glsl).
#pragma once

#include "core/math/frustum.hpp"
#include "gpu/device.hpp"
#include "scene/view.hpp"

namespace lucerna::render {

// The part of a picture that one rendering shows: all of it, or a tile.
struct Window {
  ivec2 origin{0};  // px of the picture where the window's lower left corner lies
  uvec2 size{0};    // px
};

struct ViewData {
  static constexpr const char* kPortName = "View";
  scene::View view;   // of the whole picture
  uvec2 size{0};      // px of the whole picture
  Window window;      // what is drawn of it
  gpu::Buffer block;  // ViewBlock

  Frustum frustumW() const;  // of the window
};

// Fills `data` for a view of a picture of the given size; reuses its buffer.
void updateView(gpu::Device& device, ViewData& data, const scene::View& view, uvec2 size);
void updateView(gpu::Device& device, ViewData& data, const scene::View& view, uvec2 size,
                const Window& window);

}  // namespace lucerna::render
