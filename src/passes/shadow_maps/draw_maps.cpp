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

// Lines and points throw no shadows.
bool isCaster(const render::GpuScene& gpuScene, std::uint32_t index, bool translucent) {
  const scene::Object& object = gpuScene.scene->objects[index];
  const auto alphaMode = gpuScene.scene->materials[object.material].alphaMode;
  return (alphaMode == scene::AlphaMode::Blend) == translucent &&
         gpuScene.meshes[object.mesh].topology == gpu::Topology::Triangles;
}

std::vector<std::uint32_t> castersOf(const render::GpuScene& gpuScene, const Map& map,
                                     bool translucent) {
  std::vector<std::uint32_t> seen;
  gpuScene.bvh.query(viewOf(map).frustumW(), seen);
  std::erase_if(seen, [&](std::uint32_t index) { return !isCaster(gpuScene, index, translucent); });
  return seen;
}

// An object in a view. Ordered so that objects of one batch and mesh follow each other.
struct Caster {
  std::uint32_t material =
      scene::kNone;  // none: any of which depth is drawn without a test of alpha
  bool mirrored = false;
  std::uint32_t mesh = 0, object = 0, view = 0;
  auto operator<=>(const Caster&) const = default;
};
Caster casterOf(const render::GpuScene& gpuScene, std::uint32_t index, std::uint32_t view) {
  const scene::Object& object = gpuScene.scene->objects[index];
  const auto alphaMode = gpuScene.scene->materials[object.material].alphaMode;
  return {.material = alphaMode == scene::AlphaMode::Opaque ? scene::kNone : object.material,
          .mirrored = alphaMode == scene::AlphaMode::Blend && gpuScene.mirrored[index],
          .mesh = object.mesh,
          .object = index,
          .view = view};
}

}  // namespace

bool seesPanes(const render::GpuScene& gpuScene, const Map& map) {
  return !castersOf(gpuScene, map, true).empty();
}

MapDrawer::Programs::Programs(gpu::Device& device, bool layered, bool warped)
    : depth(device, "render/depth.frag", definesOf(layered, warped)),
      transmission(device, "render/transmission.frag", definesOf(layered, warped)) {}

MapDrawer::MapDrawer(gpu::Device& device, bool layered)
    : device_(device),
      layered_(layered),
      programs_(device, layered, false),
      warpedPrograms_(device, layered, true) {}

void MapDrawer::draw(const render::GpuScene& gpuScene, const gpu::Texture& depth,
                     const render::ShadowMaps::Panes& panes, std::vector<Map> maps) {
  used_ = 0;
  // Maps that have a program and a place in common follow each other.
  std::ranges::stable_sort(maps, {}, [](const Map& map) {
    return std::tuple(map.projection.warped, map.place.side, map.place.corner.y,
                      map.place.corner.x);
  });
  const auto clear = [&](const gpu::Texture& texture, const Map& map) {
    device_.clear(texture, vec4(0.f), map.place.layer, rectOf(map.place));
  };
  const auto layerOf = [&](const Map& map) { return layered_ ? -1 : map.place.layer; };
  const auto programsOf = [&](const Map& map) -> Programs& {
    return map.projection.warped ? warpedPrograms_ : programs_;
  };
  for (const Map& map : maps) clear(depth, map);
  forGroups(gpuScene, maps, Casters::Opaque, [&](const Group& group, const Map& first) {
    // Back faces throw shadows, too: a wall is no less opaque from behind.
    draw(group, gpuScene, {.colors = {}, .depth = {.texture = &depth, .layer = layerOf(first)}},
         {.depthTest = true, .depthWrite = true, .cull = gpu::Cull::None}, programsOf(first).depth,
         first.place);
  });

  std::erase_if(maps, [](const Map& map) { return !map.seesPanes; });
  for (const Map& map : maps) clear(panes.halvings, map), clear(panes.depth, map);
  forGroups(gpuScene, maps, Casters::Panes, [&](const Group& group, const Map& first) {
    const gpu::DepthTarget opaque{.texture = &depth, .layer = layerOf(first)};
    const gpu::ColorTarget halvings{.texture = &panes.halvings, .layer = layerOf(first)};
    draw(group, gpuScene, {.colors = {halvings}, .depth = opaque},
         {.depthTest = true, .blend = gpu::Blend::Add}, programsOf(first).transmission,
         first.place);
    draw(group, gpuScene,
         {.colors = {}, .depth = {.texture = &panes.depth, .layer = layerOf(first)}},
         {.depthTest = true, .depthWrite = true}, programsOf(first).depth, first.place);
  });
}

template <typename Draw>
void MapDrawer::forGroups(const render::GpuScene& gpuScene, std::span<const Map> maps,
                          Casters casters, const Draw& draw) {
  for (; !maps.empty(); ++used_) {
    if (used_ == groups_.size()) groups_.emplace_back();
    const std::size_t count = fill(groups_[used_], gpuScene, maps, casters);
    draw(groups_[used_], maps.front());
    maps = maps.subspan(count);
  }
}

std::size_t MapDrawer::fill(Group& group, const render::GpuScene& gpuScene,
                            std::span<const Map> maps, Casters casters) {
  std::vector<render::blocks::ShadowViewValues> views;
  std::vector<Caster> drawn;
  for (const Map& map : maps) {
    const std::vector<std::uint32_t> seen = castersOf(gpuScene, map, casters == Casters::Panes);
    const bool fits = layered_ && map.projection.warped == maps.front().projection.warped &&
                      rectOf(map.place) == rectOf(maps.front().place) &&
                      drawn.size() + seen.size() <= gpuScene.longestList();
    if (!views.empty() && !fits) break;
    const auto view = static_cast<std::uint32_t>(views.size());
    views.push_back(valuesOf(map));
    for (const std::uint32_t index : seen) drawn.push_back(casterOf(gpuScene, index, view));
  }
  std::ranges::sort(drawn);
  group.list.depthOnly = casters == Casters::Opaque;
  group.list.objects.clear();
  group.list.views.clear();
  for (const Caster& caster : drawn) {
    group.list.objects.push_back(caster.object);
    group.list.views.push_back(caster.view);
  }
  finishList(device_, gpuScene, group.list);
  device_.write(group.views, std::as_bytes(std::span(views)), "ShadowViewBlock");
  return views.size();
}

void MapDrawer::draw(const Group& group, const render::GpuScene& gpuScene, gpu::Targets targets,
                     const gpu::RenderState& state, render::ObjectPrograms& programs,
                     const render::ShadowMaps::Place& square) {
  targets.viewport = rectOf(square);
  gpu::Rendering rendering = device_.render(targets);
  rendering.setScissor(targets.viewport);
  rendering.buffer("ShadowViewBlock", group.views);
  drawList(rendering, gpuScene, group.list, state,
           [&](const scene::Material& material) { return &programs.of(material); });
}

}  // namespace lucerna::passes
