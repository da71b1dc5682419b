// The resource "view": where this picture is seen from, on the CPU and as the uniform block
// `ViewBlock` (render/view.glsl).
#pragma once

#include "core/math/frustum.hpp"
#include "gpu/device.hpp"
#include "scene/view.hpp"

namespace lucerna::render {

namespace blocks {
struct ViewValues;  // render/blocks.hpp
}

// The part of a picture that one rendering shows: all of it, or a tile.
struct Window {
  ivec2 origin{0};  // px of the picture where the window's lower left corner lies
  uvec2 size{0};    // px
};

// What the view can see in a window of a picture of the given size. The near plane of what a mirror
// shows is the mirror.
Frustum frustumW(const scene::View& view, uvec2 size, const Window& window);

struct ViewData {
  static constexpr const char* kPortName = "View";
  scene::View view;  // of the whole picture
  uvec2 size{0};     // px of the whole picture
  Window window;     // what is drawn of it
  // For drawing what is projected (windowPosition() of render/view.glsl) into the window's
  // textures.
  gpu::Rect viewport;
  gpu::Buffer block;  // ViewBlock

  Frustum frustumW() const { return render::frustumW(view, size, window); }
};

// In px from the window's lower left corner: the whole picture, so that a tile is rasterised as the
// picture is, and its edges are the same. Along a side of more than maxSide px, the window.
gpu::Rect viewportOf(uvec2 size, const Window& window, int maxSide);

// What ViewBlock holds of it.
blocks::ViewValues viewValues(const ViewData& data);

// Fills `data` for a view of a picture of the given size; reuses its buffer.
void updateView(gpu::Device& device, ViewData& data, const scene::View& view, uvec2 size);
void updateView(gpu::Device& device, ViewData& data, const scene::View& view, uvec2 size,
                const Window& window);

}  // namespace lucerna::render
