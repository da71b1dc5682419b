#include "render/view_data.hpp"

#include "render/blocks.hpp"

namespace lucerna::render {
namespace {

using dmat4 = glm::dmat4;

blocks::ViewValues viewValues(const scene::View& view, uvec2 size) {
  const vec2 pixels(size);
  const vec4 eyeW = view.orthographic ? vec4(glm::normalize(vec3(view.worldFromView[2])), 0.f)
                                      : vec4(view.positionW(), 1.f);
  return {.viewFromWorld = view.viewFromWorld,
          .worldFromView = view.worldFromView,
          .clipFromView = view.clipFromView,
          .viewFromClip = mat4(glm::inverse(dmat4(view.clipFromView))),
          .eyeW = eyeW,
          .size = vec4(pixels, 1.f / pixels)};
}

}  // namespace

void updateView(gpu::Device& device, ViewData& data, const scene::View& view, uvec2 size) {
  CHECK(size.x > 0 && size.y > 0, "a view of {} x {} pixels", size.x, size.y);
  data.view = view;
  data.size = size;
  const blocks::ViewValues values = viewValues(view, size);
  device.write(data.block, std::as_bytes(std::span(&values, 1)), "ViewBlock");
}

}  // namespace lucerna::render
