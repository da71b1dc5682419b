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
      .range(kLeastSide, 8192)
      .unit("px")
      .help(
          "Side of a spot light's map, and of each of the six of a point light, where its reach "
          "fills the picture's shorter side; half of it where that fills half, down to an "
          "eighth. Rounded down to a power of two.");
  d.param("localLights", &Params::localLights)
      .range(0, 256)
      .help("Most spot and point lights that throw shadows: those that light the view most.");
  d.param("localMemory", &Params::localMemory)
      .range(1, 2048)
      .unit("MiB")
      .help(
          "Most memory for their maps: 384 MiB hold the six of 64 point lights at 512 texels. "
          "Where more is wanted, maps of those that light the view least are smaller. With "
          "translucent surfaces in the scene a texel takes 16 bytes instead of 4.");
  d.param("redraw", &Params::redraw)
      .choices({"changed", "always"})
      .help(
          "changed: a map is drawn where its light, the views or any object have changed since; "
          "always: in every frame.");
  d.read("scene", &Ports::scene)
      .help("What throws shadows; translucent surfaces colour the light.");
  d.read("lights", &Ports::lights).help("Lights that are on.");
  d.read("views", &Ports::views).help("All that they see is in the maps.");
  d.write("shadowMaps", &Ports::shadowMaps).help("Maps, and which light they belong to.");
}

void ShadowMaps::warnOfLamps(int withMaps, int leftOut, const char* remedy) {
  if (leftOut > mostLeftOut_)
    log::warning(
        "ShadowMaps: beside {} lamps, {} in sight throw no shadow; ShadowMaps.{} allows more",
        withMaps, leftOut, remedy);
  mostLeftOut_ = std::max(mostLeftOut_, leftOut);
}

void ShadowMaps::execute(graph::PassContext& context, const Params& params, const Ports& ports) {
  const bool translucent = std::ranges::any_of(
      ports.scene->scene->materials,
      [](const scene::Material& m) { return m.alphaMode == scene::AlphaMode::Blend; });
  ShadowMapPlan plan = planShadowMaps(params, ports.lights->lights, ports.views->views,
                                      {ports.scene->bvh, translucent}, lamps_);
  warnOfLamps(plan.lampsWithMaps, plan.lampsOverCount + plan.lampsOverMemory,
              plan.lampsOverMemory > 0 ? "localMemory" : "localLights");
  plan.directional.remedy = params.method == Method::Cascades
                                ? "set size or cascades of ShadowMaps lower"
                                : "set size of ShadowMaps lower";
  plan.local.remedy = "set localMemory of ShadowMaps lower";
  render::ShadowMaps& out = *ports.shadowMaps;
  out.maps = std::move(plan.maps);
  out.ofLight = std::move(plan.ofLight);
  if (translucent)
    for (render::ShadowMaps::Map& map : out.maps) map.seesPanes = seesPanes(*ports.scene, map);
  prepareShadowMaps(context.device, out, plan.directional, plan.local);
  std::vector<render::ShadowMaps::Map> directional, local;
  for (const render::ShadowMaps::Map& map : out.maps) {
    const render::ShadowMaps::Drawn wanted{map.place, map.projection,
                                           ports.scene->geometryRevision};
    if (params.redraw == Redraw::Changed && std::ranges::find(out.drawn, wanted) != out.drawn.end())
      continue;
    (map.place.local ? local : directional).push_back(map);
    std::erase_if(out.drawn, [&](const render::ShadowMaps::Drawn& drawn) {
      return drawn.place.overlaps(map.place);
    });
    out.drawn.push_back(wanted);
    ++out.revision;
  }
  drawer_.draw(*ports.scene, out.directional, out.directionalPanes, std::move(directional));
  drawer_.draw(*ports.scene, out.local, out.localPanes, std::move(local));
}

}  // namespace lucerna::passes
