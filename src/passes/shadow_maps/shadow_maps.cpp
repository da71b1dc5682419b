#include "passes/shadow_maps/shadow_maps.hpp"

#include <algorithm>

#include "core/log.hpp"
#include "passes/shadow_maps/plan_shadow_maps.hpp"

namespace lucerna::passes {
void ShadowMaps::describe(graph::PassInfo<Params, Ports>& d) {
  d.pass("ShadowMaps", "Draws the depth that lights see, for all pictures of a frame at once.");
  d.runs(graph::Frequency::PerViewGroup);
  d.needs(gpu::kFeatureMultiDrawIndirect);
  d.param("method", &Params::method)
      .choices({"lispsm", "uniform", "cascades"})
      .help(
          "Of directional lights. lispsm: one map, warped so that texels are small near the "
          "camera; uniform: one map; cascades: several uniform ones, each for a part of the "
          "distance.");
  d.param("size", &Params::size)
      .range(64, 8192)
      .unit("px")
      .help("Side of a directional light's map.");
  d.param("warp", &Params::warp)
      .choices({"automatic", "set"})
      .help("Whether lispsm chooses its strength by the view or takes warpStrength.");
  d.param("warpStrength", &Params::warpStrength)
      .range(0, 1000)
      .help(
          "0: a uniform map; s: across the light, what is farthest has texels 1 + s times as wide "
          "as the nearest, and the square of that as long.");
  d.param("cascades", &Params::cascades).range(1, 8).help("Maps of a directional light.");
  d.param("localSize", &Params::localSize)
      .range(16, 8192)
      .unit("px")
      .help("Side of a spot light's map, and of each of the six of a point light.");
  d.param("localLights", &Params::localLights)
      .range(0, 256)
      .help("Most spot and point lights that throw shadows: those that light the view most.");
  d.param("redraw", &Params::redraw)
      .choices({"changed", "always"})
      .help(
          "changed: a map is drawn where its light, the views or any object have changed since; "
          "always: in every frame.");
  d.read("scene", &Ports::scene).help("What throws shadows: all but translucent surfaces.");
  d.read("lights", &Ports::lights).help("Lights that are on.");
  d.read("views", &Ports::views).help("All that they see is in the maps.");
  d.write("shadowMaps", &Ports::shadowMaps).help("Maps, and which light they belong to.");
}

const gpu::Program& ShadowMaps::programOf(const render::ShadowProjection& projection,
                                          const scene::Material& material) {
  if (!projection.warped) return programs_.of(material);
  const gpu::Program& program = warpedPrograms_.of(material);
  program.set("depthPlaneW", projection.depthPlaneW);
  return program;
}

void ShadowMaps::draw(gpu::Device& device, const Ports& ports, const render::ShadowMaps::Map& map,
                      Drawing& drawing) {
  const render::GpuScene& gpuScene = *ports.scene;
  const gpu::Texture& texture = map.local ? ports.shadowMaps->local : ports.shadowMaps->directional;
  const scene::View view{.viewFromWorld = map.projection.viewFromWorld,
                         .clipFromView = map.projection.clipFromView,
                         .worldFromView = glm::inverse(map.projection.viewFromWorld),
                         .orthographic = !map.local};
  render::updateView(device, drawing.view, view, uvec2(texture.width(), texture.height()));

  std::vector<std::uint32_t>& casters = drawing.list.objects;
  casters.clear();
  gpuScene.bvh.query(view.frustumW(), casters);
  std::erase_if(casters, [&](std::uint32_t index) {
    const scene::Object& object = gpuScene.scene->objects[index];
    return gpuScene.scene->materials[object.material].alphaMode == scene::AlphaMode::Blend ||
           gpuScene.meshes[object.mesh].topology != gpu::Topology::Triangles;
  });
  render::sortForState(gpuScene, casters);
  finishList(device, gpuScene, drawing.list);

  gpu::Rendering rendering = device.render(
      {.colors = {}, .depth = {.texture = &texture, .load = gpu::Load::Clear, .layer = map.layer}});
  rendering.buffer("ViewBlock", drawing.view.block);
  // Back faces throw shadows, too: a wall is no less opaque from behind.
  drawList(rendering, gpuScene, drawing.list,
           {.depthTest = true, .depthWrite = true, .cull = gpu::Cull::None},
           [&](const scene::Material& material) { return &programOf(map.projection, material); });
}

void ShadowMaps::warnOfLamps(int leftOut, int allowed) {
  if (leftOut > mostLeftOut_)
    log::warning(
        "ShadowMaps: beside {} lamps, {} in sight throw no shadow; localLights allows more",
        allowed, leftOut);
  mostLeftOut_ = std::max(mostLeftOut_, leftOut);
}

void ShadowMaps::execute(graph::PassContext& context, const Params& params, const Ports& ports) {
  ShadowMapPlan plan =
      planShadowMaps(params, ports.lights->lights, ports.views->views, ports.scene->bvh);
  warnOfLamps(plan.lampsLeftOut, params.localLights);
  render::ShadowMaps& out = *ports.shadowMaps;
  out.maps = std::move(plan.maps);
  out.ofLight = std::move(plan.ofLight);
  prepareShadowMaps(
      context.device, out,
      {params.size, params.method == Method::Cascades ? "set size or cascades of ShadowMaps lower"
                                                      : "set size of ShadowMaps lower"},
      {params.localSize, "set localSize or localLights of ShadowMaps lower"});
  drawings_.resize(std::max(drawings_.size(), out.maps.size()));
  for (std::size_t i = 0; i < out.maps.size(); ++i) {
    const render::ShadowMaps::Map& map = out.maps[i];
    render::ShadowMaps::Drawn& drawn =
        (map.local ? out.drawnLocal : out.drawnDirectional)[static_cast<std::size_t>(map.layer)];
    const render::ShadowMaps::Drawn wanted{map.projection, ports.scene->geometryRevision};
    if (params.redraw == Redraw::Changed && drawn == wanted) continue;
    draw(context.device, ports, map, drawings_[i]);
    drawn = wanted;
    ++out.revision;
  }
}

}  // namespace lucerna::passes
