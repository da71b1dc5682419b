#include "passes/shadow_maps/plan_shadow_maps.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <tuple>

namespace lucerna::passes {
namespace {

// A spot light that opens wider than this on each side gets the six faces of a point light: one
// picture would have few texels in its middle.
constexpr float kWidestSpot = 1.2f;       // rad
constexpr float kBeyondSurface = 1.01f;   // of a point light: what lies on it throws no shadow
constexpr float kFaceCorner = 0.955317f;  // rad, between a face's axis and its corners

// How much of the way from equal to proportional cascades: Zhang, Sun, Xu and Lun,
// "Parallel-Split Shadow Maps for Large-scale Virtual Environments", VRCIA 2006, section 3.1.
constexpr float kSplitShare = 0.85f;

float marginOf(int size) {
  return std::min(static_cast<float>(render::kShadowMargin) / static_cast<float>(size), 0.1f);
}

float strengthOf(const scene::PlacedLight& light) {
  return std::max({light.intensity.x, light.intensity.y, light.intensity.z});
}

// Of the picture's shorter side that the lamp's reach may fill, in the view where that is most.
float shareOf(const scene::PlacedLight& light, std::span<const scene::View> views) {
  float share = 0.f;
  for (const scene::View& view : views) {
    const float distance = glm::distance(light.positionW, view.positionW());
    if (std::isinf(light.reach) || (!view.orthographic && distance <= light.reach)) return 1.f;
    const float scale = std::max(view.clipFromView[0][0], view.clipFromView[1][1]);
    share = std::max(share, scale * light.reach / (view.orthographic ? 1.f : distance));
  }
  return std::min(share, 1.f);
}

// Strength times the share of the view that the lamp's reach may fill.
float importanceOf(const scene::PlacedLight& light, vec3 eyeW) {
  if (std::isinf(light.reach)) return strengthOf(light);
  const float size = light.reach / (light.reach + glm::distance(light.positionW, eyeW));
  return strengthOf(light) * size * size;
}

bool mayBeInSight(const scene::PlacedLight& light, std::span<const scene::View> views,
                  const Aabb& boxW) {
  if (strengthOf(light) <= 0.f || light.reach <= 0.f) return false;
  if (std::isinf(light.reach)) return true;
  const Aabb reached{light.positionW - light.reach, light.positionW + light.reach};
  const auto overlap =
      glm::lessThanEqual(reached.min, boxW.max) && glm::lessThanEqual(boxW.min, reached.max);
  return glm::all(overlap) && std::ranges::any_of(views, [&](const scene::View& view) {
           return intersects(view.frustumW(), reached);
         });
}

// The lamps that light something in sight, most important first.
std::vector<std::uint32_t> lampsOf(std::span<const scene::PlacedLight> lights,
                                   std::span<const scene::View> views, const Aabb& boxW) {
  const vec3 eyeW = render::viewerOf(views).positionW;
  std::vector<std::tuple<float, std::uint32_t>> keyed;
  for (std::uint32_t i = 0; i < lights.size(); ++i)
    if (lights[i].kind != scene::LightKind::Directional && mayBeInSight(lights[i], views, boxW))
      keyed.emplace_back(-importanceOf(lights[i], eyeW), i);
  std::ranges::sort(keyed);
  std::vector<std::uint32_t> lamps;
  for (const auto& [key, index] : keyed) lamps.push_back(index);
  return lamps;
}

// A point light is a sphere: what lies in it or on it, its bulb for instance, throws no shadow, nor
// does what else lies in the cube around it.
std::vector<render::LightPyramid> pyramidsOf(const scene::PlacedLight& light) {
  const float angle = std::acos(std::clamp(light.cosOuter, -1.f, 1.f));
  if (light.kind == scene::LightKind::Spot && angle <= kWidestSpot)
    return {{.positionW = light.positionW,
             .axisW = light.directionW,
             .tangent = std::tan(std::max(angle, 1e-3f)),
             .reach = light.reach}};
  // A face that the cone does not reach by its corner is dark.
  const float darkFrom = light.kind == scene::LightKind::Spot ? angle + kFaceCorner : kPi;
  std::vector<render::LightPyramid> faces;
  for (const vec3 axis : {vec3(1, 0, 0), vec3(-1, 0, 0), vec3(0, 1, 0), vec3(0, -1, 0),
                          vec3(0, 0, 1), vec3(0, 0, -1)})
    if (std::acos(std::clamp(glm::dot(axis, light.directionW), -1.f, 1.f)) <= darkFrom)
      faces.push_back(
          {.positionW = light.positionW,
           .axisW = axis,
           .reach = light.reach,
           .near = light.kind == scene::LightKind::Point ? kBeyondSurface * light.radius : 0.f});
  return faces;
}

// Layers of the lamps' texture: of a power of two, so that maps halve evenly; of less than
// localSize where not even one would fit the budget.
render::ShadowMapSize layersOf(int localSize, int localMemory, bool translucent) {
  const std::int64_t bytesOfTexel = translucent ? 4 + 8 + 4 : 4;  // of render::ShadowMaps
  constexpr std::int64_t kMostLayers = 2048;                      // that OpenGL 4.5 promises
  const std::int64_t texels = (std::int64_t{localMemory} << 20) / bytesOfTexel;
  auto side = static_cast<std::int64_t>(std::bit_floor(static_cast<unsigned>(localSize)));
  while (side * side > texels) side /= 2;
  return {.side = static_cast<int>(side),
          .layers = static_cast<int>(std::min(texels / (side * side), kMostLayers))};
}

// The smallest size of maps: none has fewer texels on a side than localSize may have.
int smallestSizeOf(int side) {
  int size = 0;
  while (size + 1 < ShadowAtlas::kSizes && side >> (size + 1) >= ShadowMaps::kLeastSide) ++size;
  return size;
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
  far = std::max(far, 1e-6f);
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

class Planner {
 public:
  Planner(const ShadowMaps::Params& params, std::span<const scene::PlacedLight> lights,
          std::span<const scene::View> views, const Surfaces& surfaces, LampMaps& former)
      : params_(params),
        lights_(lights),
        views_(views),
        boxW_(surfaces.bvh.nodes()[0].box),
        body_(render::visibleBody(views, boxW_)),
        samples_(render::visibleSamples(views, surfaces.bvh)),
        translucent_(surfaces.translucent),
        former_(former) {
    plan_.ofLight.resize(lights.size());
  }

  void directional(std::uint32_t light) {
    if (body_.empty() || strengthOf(lights_[light]) <= 0.f) return;
    if (params_.method != ShadowMaps::Method::Cascades) {
      addDirectional(light, body_, warpOf(lights_[light].directionW));
      return;
    }
    const std::vector<float> splits = splitsOf(viewer_, body_, params_.cascades);
    for (std::size_t i = 0; i + 1 < splits.size(); ++i) {
      const auto slice = sliceOf(viewer_, splits[i], splits[i + 1]);
      const std::vector<vec3> part = render::visibleBody(views_, boxW_, slice);
      if (!part.empty()) addDirectional(light, part, 0.f);
    }
  }

  // lamps: most important first.
  void local(const std::vector<std::uint32_t>& lamps) {
    const auto [side, mostLayers, remedy] =
        layersOf(params_.localSize, params_.localMemory, translucent_);
    std::vector<LampSizes::Lamp> sized;
    std::vector<std::vector<Face>> faces;
    for (const std::uint32_t light : lamps) {
      if (static_cast<int>(faces.size()) == params_.localLights) {
        ++plan_.lampsOverCount;
        continue;
      }
      faces.push_back(facesOf(light));
      if (faces.back().empty()) {
        faces.pop_back();
        continue;
      }
      sized.push_back({.light = lights_[light].light,
                       .share = shareOf(lights_[light], views_),
                       .importance = importanceOf(lights_[light], viewer_.positionW),
                       .maps = static_cast<int>(faces.back().size())});
    }
    const std::vector<int> sizes =
        former_.sizes.choose(sized, smallestSizeOf(side), ShadowAtlas::kCells * mostLayers);
    plan_.lampsWithMaps = static_cast<int>(sizes.size());
    plan_.lampsOverMemory = static_cast<int>(faces.size() - sizes.size());
    faces.resize(sizes.size());
    former_.atlas.reshape(side, mostLayers);
    addLamps(faces, sizes);
    plan_.local = {.side = side, .layers = former_.atlas.layers()};
  }

  ShadowMapPlan take() {
    plan_.directional = {.side = params_.size, .layers = directionalLayers_};
    return std::move(plan_);
  }

 private:
  // A map of a lamp before its size is known.
  struct Face {
    std::uint32_t light = 0;  // index in lights_
    std::uint64_t key = 0;    // the same from frame to frame
    render::LightPyramid pyramid;
    std::vector<vec3> bodyW;  // what it is to show
  };

  // That see something.
  std::vector<Face> facesOf(std::uint32_t light) const {
    std::vector<Face> faces;
    std::uint64_t key = std::uint64_t{lights_[light].light} << 3;
    for (const render::LightPyramid& pyramid : pyramidsOf(lights_[light])) {
      std::vector<vec3> bodyW = render::litBody(pyramid, views_, boxW_);
      if (!bodyW.empty()) faces.push_back({light, key, pyramid, std::move(bodyW)});
      ++key;
    }
    return faces;
  }

  void addLamps(const std::vector<std::vector<Face>>& faces, const std::vector<int>& sizes) {
    std::vector<ShadowAtlas::Wish> wishes;
    for (std::size_t lamp = 0; lamp < faces.size(); ++lamp)
      for (const Face& face : faces[lamp]) wishes.push_back({face.key, sizes[lamp]});
    const std::vector<ShadowAtlas::Square> squares = former_.atlas.place(wishes);
    auto square = squares.begin();
    for (const std::vector<Face>& ofLamp : faces)
      for (const Face& face : ofLamp) {
        const auto [layer, corner, side] = *square++;
        add(face.light,
            {.projection = render::localProjection(face.pyramid, face.bodyW, marginOf(side)),
             .place = {.local = true, .layer = layer, .corner = corner, .side = side}});
      }
  }

  float warpOf(vec3 directionW) const {
    if (params_.method == ShadowMaps::Method::Uniform) return 0.f;
    if (params_.warp == ShadowMaps::Warp::Automatic)
      return render::automaticWarp(directionW, body_, samples_, viewer_);
    return params_.warpStrength * glm::length(glm::cross(directionW, viewer_.forwardW));
  }

  void addDirectional(std::uint32_t light, const std::vector<vec3>& body, float warp) {
    add(light, {.projection = render::directionalProjection(lights_[light].directionW, body, boxW_,
                                                            viewer_, warp, marginOf(params_.size)),
                .place = {.layer = directionalLayers_++, .side = params_.size}});
  }

  void add(std::uint32_t light, const render::ShadowMaps::Map& map) {
    render::ShadowMaps::Range& range = plan_.ofLight[light];
    if (range.count == 0) range.first = static_cast<std::uint32_t>(plan_.maps.size());
    ++range.count;
    plan_.maps.push_back(map);
  }

  const ShadowMaps::Params& params_;
  std::span<const scene::PlacedLight> lights_;
  std::span<const scene::View> views_;
  const Aabb boxW_;
  const std::vector<vec3> body_, samples_;
  const render::Viewer viewer_ = render::viewerOf(views_);
  const bool translucent_;
  LampMaps& former_;
  int directionalLayers_ = 0;
  ShadowMapPlan plan_;
};

}  // namespace

ShadowMapPlan planShadowMaps(const ShadowMaps::Params& params,
                             std::span<const scene::PlacedLight> lights,
                             std::span<const scene::View> views, const Surfaces& surfaces,
                             LampMaps& former) {
  if (surfaces.bvh.nodes().empty())
    return {.ofLight = std::vector<render::ShadowMaps::Range>(lights.size())};
  Planner planner(params, lights, views, surfaces, former);
  for (std::uint32_t i = 0; i < lights.size(); ++i)
    if (lights[i].kind == scene::LightKind::Directional) planner.directional(i);
  planner.local(lampsOf(lights, views, surfaces.bvh.nodes()[0].box));
  return planner.take();
}

}  // namespace lucerna::passes
