#include "render/view_data.hpp"

#include "render/blocks.hpp"

namespace lucerna::render {
namespace {

using dmat4 = glm::dmat4;

// Normalised device coordinates of a part of the picture from those of the picture: factors and
// shifts. For the whole picture they are exactly 1 and 0.
vec4 partFromClip(uvec2 size, const glm::dvec2& origin, const glm::dvec2& part) {
  const glm::dvec2 picture(size);
  return {vec2(picture / part), vec2((picture - 2. * origin - part) / part)};
}

vec4 windowFromClip(uvec2 size, const Window& window) {
  return partFromClip(size, glm::dvec2(window.origin), glm::dvec2(window.size));
}

vec4 viewportFromClip(const ViewData& data) {
  const gpu::Rect& viewport = data.viewport;
  return partFromClip(data.size, glm::dvec2(data.window.origin + ivec2(viewport.x, viewport.y)),
                      {viewport.width, viewport.height});
}

}  // namespace

Frustum frustumW(const scene::View& view, uvec2 size, const Window& window) {
  const vec4 part = windowFromClip(size, window);
  mat4 toWindow(1.f);
  toWindow[0].x = part.x;
  toWindow[1].y = part.y;
  toWindow[3].x = part.z;
  toWindow[3].y = part.w;
  Frustum frustum = frustumOf(toWindow * view.clipFromWorld());
  if (view.clipPlaneW) frustum.planes[Frustum::kNear] = *view.clipPlaneW;
  return frustum;
}

gpu::Rect viewportOf(uvec2 size, const Window& window, int maxSide) {
  const ivec2 picture(size), part(window.size);
  gpu::Rect viewport{-window.origin.x, -window.origin.y, picture.x, picture.y};
  if (picture.x > maxSide) viewport.x = 0, viewport.width = part.x;
  if (picture.y > maxSide) viewport.y = 0, viewport.height = part.y;
  return viewport;
}

blocks::ViewValues viewValues(const ViewData& data) {
  const scene::View& view = data.view;
  const vec2 pixels(data.size);
  return {.viewFromWorld = view.viewFromWorld,
          .worldFromView = view.worldFromView,
          .clipFromView = view.clipFromView,
          .viewFromClip = mat4(glm::inverse(dmat4(view.clipFromView))),
          .eyeW = view.eyeW(),
          .size = vec4(pixels, 1.f / pixels),
          .window = vec4(vec2(data.window.origin), vec2(data.window.size)),
          .viewportFromClip = viewportFromClip(data),
          .clipPlaneW = view.clipPlaneW.value_or(vec4(0.f, 0.f, 0.f, 1.f))};
}

void updateView(gpu::Device& device, ViewData& data, const scene::View& view, uvec2 size) {
  updateView(device, data, view, size, {.origin = ivec2(0), .size = size});
}

void updateView(gpu::Device& device, ViewData& data, const scene::View& view, uvec2 size,
                const Window& window) {
  CHECK(size.x > 0 && size.y > 0, "a view of {} x {} pixels", size.x, size.y);
  CHECK(window.size.x > 0 && window.size.y > 0, "a window of {} x {} pixels", window.size.x,
        window.size.y);
  data.view = view;
  data.size = size;
  data.window = window;
  data.viewport = viewportOf(size, window, device.capabilities().maxTextureSide);
  const blocks::ViewValues values = viewValues(data);
  device.write(data.block, std::as_bytes(std::span(&values, 1)), "ViewBlock");
}

}  // namespace lucerna::render
