#include "passes/shadow_maps/shadow_maps.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "core/log.hpp"

namespace lucerna::passes {
namespace {

// A spot light that opens wider than this on each side gets the six faces of a point light: one
// picture would have few texels in its middle.
constexpr float kWidestSpot = 1.2f;  // rad

// How much of the way from equal to proportional cascades: Zhang, Sun, Xu and Lun,
// "Parallel-Split Shadow Maps for Large-scale Virtual Environments", VRCIA 2006, section 3.1.
constexpr float kSplitShare = 0.85f;

float marginOf(int size) {
  return std::min(static_cast<float>(render::kShadowMargin) / static_cast<float>(size), 0.1f);
}

// What a lamp gives to the eye's surroundings: those that give most have shadows.
float importanceOf(const scene::PlacedLight& light, vec3 eyeW) {
  const float strength = std::max({light.intensity.x, light.intensity.y, light.intensity.z});
  return strength * scene::attenuationAt(light, 0.5f * glm::distance(light.positionW, eyeW));
}

// The lamps that may have maps, most important first.
std::vector<std::uint32_t> lampsOf(const render::LightList& lights, const render::Viewer& viewer) {
  std::vector<std::tuple<float, std::uint32_t>> keyed;
  for (std::uint32_t i = 0; i < lights.lights.size(); ++i)
    if (const scene::PlacedLight& light = lights.lights[i];
        light.kind != scene::LightKind::Directional)
      keyed.emplace_back(-importanceOf(light, viewer.positionW), i);
  std::ranges::sort(keyed);
  std::vector<std::uint32_t> lamps;
  for (const auto& [key, index] : keyed) lamps.push_back(index);
  return lamps;
}

std::vector<render::LightPyramid> pyramidsOf(const scene::PlacedLight& light) {
  const float angle = std::acos(std::clamp(light.cosOuter, -1.f, 1.f));
  if (light.kind == scene::LightKind::Spot && angle <= kWidestSpot)
    return {{.positionW = light.positionW,
             .axisW = light.directionW,
             .tangent = std::tan(std::max(angle, 1e-3f)),
             .reach = light.reach}};
  std::vector<render::LightPyramid> faces;
  for (const vec3 axis : {vec3(1, 0, 0), vec3(-1, 0, 0), vec3(0, 1, 0), vec3(0, -1, 0),
                          vec3(0, 0, 1), vec3(0, 0, -1)})
    faces.push_back({.positionW = light.positionW, .axisW = axis, .reach = light.reach});
  return faces;
}

// Half-spaces between two distances before the viewer.
std::array<vec4, 2> sliceOf(const render::Viewer& viewer, float from, float to) {
  const float eye = glm::dot(viewer.forwardW, viewer.positionW);
  return {vec4(viewer.forwardW, -(eye + from)), vec4(-viewer.forwardW, eye + to)};
}

// Distances at which `count` cascades of the body begin and end.
std::vector<float> splitsOf(const render::Viewer& viewer, const std::vector<vec3>& body,
                            int count) {
  float near = std::numeric_limits<float>::infinity(), far = 0.f;
  for (const vec3& point : body) {
    const float distance = glm::dot(viewer.forwardW, point - viewer.positionW);
    near = std::min(near, distance), far = std::max(far, distance);
  }
  const float first = std::max(near, 0.005f * far);  // of the proportional ones
  std::vector<float> splits{near};
  for (int i = 1; i < count; ++i) {
    const float share = static_cast<float>(i) / static_cast<float>(count);
    const float equal = glm::mix(first, far, share);
    const float proportional = first * std::pow(far / first, share);
    splits.push_back(glm::mix(equal, proportional, kSplitShare));
  }
  splits.push_back(far);
  return splits;
}

}  // namespace

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
      .help("0: a uniform map; s: what is farthest has texels 1 + s times as wide as the nearest.");
  d.param("cascades", &Params::cascades).range(1, 8).help("Maps of a directional light.");
  d.param("localSize", &Params::localSize)
      .range(16, 8192)
      .unit("px")
      .help("Side of a spot light's map, and of each of the six of a point light.");
  d.param("localLights", &Params::localLights)
      .range(0, 256)
      .help("Most spot and point lights that throw shadows: those that light the view most.");
  d.read("scene", &Ports::scene).help("What throws shadows: all but translucent surfaces.");
  d.read("lights", &Ports::lights).help("Lights that are on.");
  d.read("views", &Ports::views).help("All that they see is in the maps.");
  d.write("shadowMaps", &Ports::shadowMaps).help("Maps, and which light they belong to.");
}

void ShadowMaps::addMap(const Ports& ports, std::uint32_t light,
                        const render::ShadowProjection& projection, bool local) {
  render::ShadowMaps& out = *ports.shadowMaps;
  render::ShadowMaps::Range& range = out.ofLight[light];
  if (range.count == 0) range.first = static_cast<std::uint32_t>(out.maps.size());
  ++range.count;
  int& layers = local ? localLayers_ : directionalLayers_;
  out.maps.push_back({.projection = projection, .local = local, .layer = layers++});
}

void ShadowMaps::planDirectional(const Params& params, const Ports& ports, const Aabb& castersW,
                                 std::uint32_t light) {
  const vec3 directionW = ports.lights->lights[light].directionW;
  const render::Viewer viewer = render::viewerOf(ports.views->views);
  const std::vector<vec3> body = render::visibleBody(ports.views->views, castersW);
  if (body.empty()) return;
  const float margin = marginOf(params.size);
  if (params.method != Method::Cascades) {
    const float sine = glm::length(glm::cross(directionW, viewer.forwardW));
    float warp = 0.f;
    if (params.method == Method::Lispsm)
      warp = params.warp == Warp::Set
                 ? params.warpStrength * sine
                 : render::automaticWarp(
                       directionW, body,
                       render::visibleSamples(ports.views->views, ports.scene->bvh), viewer);
    addMap(ports, light,
           render::directionalProjection(directionW, body, castersW, viewer, warp, margin), false);
    return;
  }
  const std::vector<float> splits = splitsOf(viewer, body, params.cascades);
  for (std::size_t i = 0; i + 1 < splits.size(); ++i) {
    const auto slice = sliceOf(viewer, splits[i], splits[i + 1]);
    const std::vector<vec3> part = render::visibleBody(ports.views->views, castersW, slice);
    if (part.empty()) continue;
    addMap(ports, light,
           render::directionalProjection(directionW, part, castersW, viewer, 0.f, margin), false);
  }
}

bool ShadowMaps::planLocal(const Params& params, const Ports& ports, const Aabb& castersW,
                           std::uint32_t light, bool mayHaveMaps) {
  bool lightsTheViews = false;
  for (const render::LightPyramid& pyramid : pyramidsOf(ports.lights->lights[light])) {
    const auto projection =
        render::localProjection(pyramid, ports.views->views, castersW, marginOf(params.localSize));
    lightsTheViews = lightsTheViews || projection;
    if (projection && mayHaveMaps) addMap(ports, light, *projection, true);
  }
  return lightsTheViews;
}

void ShadowMaps::plan(const Params& params, const Ports& ports) {
  render::ShadowMaps& out = *ports.shadowMaps;
  const render::LightList& lights = *ports.lights;
  out.maps.clear();
  out.ofLight.assign(lights.lights.size(), {});
  directionalLayers_ = localLayers_ = 0;
  const auto nodes = ports.scene->bvh.nodes();
  if (nodes.empty()) return;
  const Aabb castersW = nodes[0].box;
  for (std::uint32_t i = 0; i < lights.lights.size(); ++i)
    if (lights.lights[i].kind == scene::LightKind::Directional)
      planDirectional(params, ports, castersW, i);

  int used = 0, wanted = 0;
  for (const std::uint32_t lamp : lampsOf(lights, render::viewerOf(ports.views->views))) {
    if (!planLocal(params, ports, castersW, lamp, used < params.localLights)) continue;
    ++wanted;
    used = std::min(wanted, params.localLights);
  }
  const int leftOut = wanted - used;
  if (leftOut > leftOut_)
    log::warning("ShadowMaps: {} of {} lamps in sight throw no shadow; localLights allows {}",
                 leftOut, wanted, params.localLights);
  leftOut_ = std::max(leftOut_, leftOut);
}

const gpu::Program& ShadowMaps::programOf(const render::ShadowProjection& projection,
                                          const scene::Material& material) {
  if (projection.shear == 0.f) return programs_.of(material);
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

  visible_.clear();
  gpuScene.bvh.query(view.frustumW(), visible_);
  std::erase_if(visible_, [&](std::uint32_t index) {
    const scene::Object& object = gpuScene.scene->objects[index];
    return gpuScene.scene->materials[object.material].alphaMode == scene::AlphaMode::Blend ||
           gpuScene.meshes[object.mesh].topology != gpu::Topology::Triangles;
  });
  render::sortForState(gpuScene, visible_);
  drawing.list.objects = visible_;
  finishList(device, gpuScene, drawing.list);

  gpu::Rendering rendering = device.render(
      {.colors = {}, .depth = {.texture = &texture, .load = gpu::Load::Clear, .layer = map.layer}});
  rendering.buffer("ViewBlock", drawing.view.block);
  // Back faces throw shadows, too: a wall is no less opaque from behind.
  drawList(rendering, gpuScene, drawing.list,
           {.depthTest = true, .depthWrite = true, .cull = gpu::Cull::None},
           [&](const scene::Material& material) { return &programOf(map.projection, material); });
}

void ShadowMaps::execute(graph::PassContext& context, const Params& params, const Ports& ports) {
  plan(params, ports);
  render::ShadowMaps& out = *ports.shadowMaps;
  prepareShadowMaps(context.device, out, params.size, params.localSize);
  drawings_.resize(std::max(drawings_.size(), out.maps.size()));
  for (std::size_t i = 0; i < out.maps.size(); ++i)
    draw(context.device, ports, out.maps[i], drawings_[i]);
}

}  // namespace lucerna::passes
