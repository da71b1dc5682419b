#include "passes/shadow_maps/draw_maps.hpp"

#include <algorithm>
#include <tuple>

#include "render/blocks.hpp"
#include "render/view_data.hpp"

namespace lucerna::passes {
namespace {

using Map = render::ShadowMaps::Map;

std::map<std::string, std::string> definesOf(bool layered, bool warped) {
  std::map<std::string, std::string> defines{{"SHADOW_VIEWS", "1"}};
  if (layered) defines["SHADOW_LAYERS"] = "1";
  if (warped) defines["LINEAR_DEPTH"] = "1";
  return defines;
}

gpu::Rect rectOf(const render::ShadowMaps::Place& place) {
  return {place.corner.x, place.corner.y, place.side, place.side};
}

scene::View viewOf(const Map& map) {
  return {.viewFromWorld = map.projection.viewFromWorld,
          .clipFromView = map.projection.clipFromView,
          .worldFromView = glm::inverse(map.projection.viewFromWorld),
          .orthographic = !map.place.local};
}

render::blocks::ShadowViewValues valuesOf(const Map& map) {
  const uvec2 size(map.place.side);
  const render::ViewData data{.view = viewOf(map),
                              .size = size,
                              .window = {.origin = ivec2(0), .size = size},
                              .viewport = {0, 0, map.place.side, map.place.side},
                              .block = {}};
  return {.eye = viewValues(data),
          .depthPlaneW = map.projection.depthPlaneW,
          .place = uvec4(map.place.layer, 0, 0, 0)};
}

// All but translucent surfaces, lines and points.
bool throwsShadows(const render::GpuScene& gpuScene, std::uint32_t index) {
  const scene::Object& object = gpuScene.scene->objects[index];
  return gpuScene.scene->materials[object.material].alphaMode != scene::AlphaMode::Blend &&
         gpuScene.meshes[object.mesh].topology == gpu::Topology::Triangles;
}

// An object in a view. Ordered so that objects of one batch and mesh follow each other.
struct Caster {
  std::uint32_t material = scene::kNone;  // none: any without a test of alpha
  std::uint32_t mesh = 0, object = 0, view = 0;
  auto operator<=>(const Caster&) const = default;
};
Caster casterOf(const render::GpuScene& gpuScene, std::uint32_t index, std::uint32_t view) {
  const scene::Object& object = gpuScene.scene->objects[index];
  const bool tested =
      gpuScene.scene->materials[object.material].alphaMode == scene::AlphaMode::Mask;
  return {tested ? object.material : scene::kNone, object.mesh, index, view};
}

}  // namespace

MapDrawer::MapDrawer(gpu::Device& device, bool layered)
    : device_(device),
      layered_(layered),
      programs_(device, "render/depth.frag", definesOf(layered, false)),
      warpedPrograms_(device, "render/depth.frag", definesOf(layered, true)) {}

void MapDrawer::draw(const render::GpuScene& gpuScene, const gpu::Texture& texture,
                     std::vector<Map> maps) {
  // Maps that have a program and a place in common follow each other.
  std::ranges::stable_sort(maps, {}, [](const Map& map) {
    return std::tuple(map.projection.warped, map.place.side, map.place.corner.y,
                      map.place.corner.x);
  });
  for (const Map& map : maps) device_.clear(texture, vec4(0.f), map.place.layer, rectOf(map.place));
  std::size_t used = 0;
  for (std::span<const Map> rest(maps); !rest.empty(); ++used) {
    if (used == groups_.size()) groups_.emplace_back();
    const std::size_t count = fill(groups_[used], gpuScene, rest);
    draw(groups_[used], gpuScene, texture, rest.front());
    rest = rest.subspan(count);
  }
}

std::size_t MapDrawer::fill(Group& group, const render::GpuScene& gpuScene,
                            std::span<const Map> maps) {
  std::vector<render::blocks::ShadowViewValues> views;
  std::vector<Caster> casters;
  std::vector<std::uint32_t> seen;
  for (const Map& map : maps) {
    seen.clear();
    gpuScene.bvh.query(viewOf(map).frustumW(), seen);
    std::erase_if(seen, [&](std::uint32_t index) { return !throwsShadows(gpuScene, index); });
    const bool fits = layered_ && map.projection.warped == maps.front().projection.warped &&
                      rectOf(map.place) == rectOf(maps.front().place) &&
                      casters.size() + seen.size() <= gpuScene.longestList();
    if (!views.empty() && !fits) break;
    const auto view = static_cast<std::uint32_t>(views.size());
    views.push_back(valuesOf(map));
    for (const std::uint32_t index : seen) casters.push_back(casterOf(gpuScene, index, view));
  }
  std::ranges::sort(casters);
  group.list.depthOnly = true;
  group.list.objects.clear();
  group.list.views.clear();
  for (const Caster& caster : casters) {
    group.list.objects.push_back(caster.object);
    group.list.views.push_back(caster.view);
  }
  finishList(device_, gpuScene, group.list);
  device_.write(group.views, std::as_bytes(std::span(views)), "ShadowViewBlock");
  return views.size();
}

void MapDrawer::draw(const Group& group, const render::GpuScene& gpuScene,
                     const gpu::Texture& texture, const Map& first) {
  gpu::Rendering rendering =
      device_.render({.colors = {},
                      .depth = {.texture = &texture, .layer = layered_ ? -1 : first.place.layer},
                      .viewport = rectOf(first.place)});
  rendering.setScissor(rectOf(first.place));
  rendering.buffer("ShadowViewBlock", group.views);
  // Back faces throw shadows, too: a wall is no less opaque from behind.
  render::ObjectPrograms& programs = first.projection.warped ? warpedPrograms_ : programs_;
  drawList(rendering, gpuScene, group.list,
           {.depthTest = true, .depthWrite = true, .cull = gpu::Cull::None},
           [&](const scene::Material& material) { return &programs.of(material); });
}

}  // namespace lucerna::passes
