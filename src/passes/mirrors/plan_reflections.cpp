#include "passes/mirrors/plan_reflections.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <queue>
#include <utility>

#include "passes/mirrors/mirror_faces.hpp"

namespace lucerna::passes {
namespace {

using Polygon = std::vector<vec3>;

constexpr float kFlatness = 1e-4f;     // faces in one plane differ less, as a share of their size
constexpr float kRounding = 0x1p-20f;  // of transformed coordinates, as a share of the largest

// What of the polygon is on the positive side (Sutherland and Hodgman, 1974).
Polygon clipped(const Polygon& polygon, const vec4& plane) {
  Polygon result;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const vec3 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    const float ofA = glm::dot(plane, vec4(a, 1.f)), ofB = glm::dot(plane, vec4(b, 1.f));
    if (ofA >= 0.f) result.push_back(a);
    if ((ofA >= 0.f) != (ofB >= 0.f)) result.push_back(glm::mix(a, b, ofA / (ofA - ofB)));
  }
  return result;
}

bool isEmpty(const render::Window& window) {
  return window.size.x == 0 || window.size.y == 0;
}

// From the first pixel to the one after the last.
render::Window between(ivec2 first, ivec2 end) {
  return {.origin = first, .size = uvec2(glm::max(end - first, ivec2(0)))};
}

render::Window around(const render::Window& a, const render::Window& b) {
  if (isEmpty(a) || isEmpty(b)) return isEmpty(a) ? b : a;
  return between(glm::min(a.origin, b.origin),
                 glm::max(a.origin + ivec2(a.size), b.origin + ivec2(b.size)));
}

render::Window common(const render::Window& a, const render::Window& b) {
  return between(glm::max(a.origin, b.origin),
                 glm::min(a.origin + ivec2(a.size), b.origin + ivec2(b.size)));
}

vec4 towards(const vec4& eyeW, const vec4& planeW) {
  return glm::dot(planeW, eyeW) < 0.f ? -planeW : planeW;
}

float largestCoordinate(const MirrorFace& face) {
  float largest = 0.f;
  for (const vec3& corner : face.cornersW)
    largest = std::max({largest, std::abs(corner.x), std::abs(corner.y), std::abs(corner.z)});
  return largest;
}

class Planner {
 public:
  Planner(const render::GpuScene& gpuScene, uvec2 size, const ReflectionSettings& settings)
      : gpuScene_(gpuScene), scene_(*gpuScene.scene), size_(size), settings_(settings) {
    if (!gpuScene.bvh.nodes().empty()) boundsW_ = gpuScene.bvh.nodes()[0].box;
  }

  ReflectionPlan plan(const render::ViewData& view, std::span<const std::uint32_t> mirrors) {
    ReflectionPlan plan;
    const render::Window whole{.size = size_};
    const bool isPart = view.window.size != size_;
    const std::vector<std::uint32_t> all =
        isPart ? mirrorsIn(view.view, whole)
               : std::vector<std::uint32_t>(mirrors.begin(), mirrors.end());
    plan.reflections = reflectionsIn(view.view, whole, all);
    wait(plan.reflections, view.view, 1);
    for (; !waiting_.empty() && planned_ < settings_.budget; ++planned_) {
      const Waiting next = waiting_.top();
      waiting_.pop();
      follow(*next.reflection, *next.view, next.depth);
    }
    plan.beyondBudget = waiting_.size();
    for (; !waiting_.empty(); waiting_.pop()) waiting_.top().reflection->mirrors.clear();
    dropWithoutMirrors(plan.reflections);
    if (isPart) cut(plan.reflections, view.window);
    plan.curved = std::move(curved_);
    return plan;
  }

 private:
  struct Waiting {
    Reflection* reflection;
    const scene::View* view;  // in which it is seen
    int depth;
    std::size_t number;  // in the order in which they were found

    bool operator<(const Waiting& other) const {
      const auto pixels = [](const Waiting& w) {
        return std::size_t(w.reflection->part.size.x) * w.reflection->part.size.y;
      };
      return std::pair(pixels(*this), other.number) < std::pair(pixels(other), number);
    }
  };

  // They stay where they are from now on.
  void wait(std::vector<Reflection>& reflections, const scene::View& view, int depth) {
    for (Reflection& reflection : reflections) waiting_.push({&reflection, &view, depth, found_++});
  }

  static void dropWithoutMirrors(std::vector<Reflection>& reflections) {
    std::erase_if(reflections, [](const Reflection& r) { return r.mirrors.empty(); });
    for (Reflection& reflection : reflections) dropWithoutMirrors(reflection.within);
  }

  std::vector<std::uint32_t> mirrorsAmong(std::span<const std::uint32_t> objects) const {
    std::vector<std::uint32_t> mirrors;
    std::ranges::copy_if(objects, std::back_inserter(mirrors), [&](std::uint32_t i) {
      return isMirror(scene_.materials[scene_.objects[i].material]);
    });
    std::ranges::sort(mirrors);
    return mirrors;
  }

  std::vector<std::uint32_t> mirrorsIn(const scene::View& view, const render::Window& part) const {
    std::vector<std::uint32_t> objects;
    gpuScene_.bvh.query(render::frustumW(view, size_, part), objects);
    return mirrorsAmong(objects);
  }

  // Leaves what a window of the picture shows.
  void cut(std::vector<Reflection>& reflections, const render::Window& window) const {
    for (Reflection& reflection : reflections) reflection.part = common(reflection.part, window);
    std::erase_if(reflections, [](const Reflection& r) { return isEmpty(r.part); });
    for (Reflection& reflection : reflections) {
      reflection.visible.clear();
      gpuScene_.bvh.query(render::frustumW(reflection.view, size_, reflection.part),
                          reflection.visible);
      cut(reflection.within, window);
    }
  }

  // What mirrors show in a part of a view's picture.
  std::vector<Reflection> reflectionsIn(const scene::View& view, const render::Window& part,
                                        std::span<const std::uint32_t> mirrors) {
    std::vector<Reflection> result;
    const Frustum frustum = render::frustumW(view, size_, part);
    for (const std::uint32_t object : mirrors)
      for (const MirrorFace& face : facesOf(object)) {
        if (!reflects(object, view, face)) continue;
        const render::Window seen = windowAround(face, view, frustum, part);
        if (!isEmpty(seen)) add(object, face, towards(view.eyeW(), face.planeW), seen, result);
      }
    return result;
  }

  const std::vector<MirrorFace>& facesOf(std::uint32_t index) {
    const auto [entry, isNew] = faces_.try_emplace(index);
    if (!isNew) return entry->second;
    const scene::Object& object = scene_.objects[index];
    auto faces =
        passes::facesOf(scene_.meshes[object.mesh], scene_.nodes[object.node].worldFromNode);
    if (faces)
      entry->second = std::move(*faces);
    else
      curved_.push_back(index);
    return entry->second;
  }

  bool reflects(std::uint32_t object, const scene::View& view, const MirrorFace& face) const {
    const float side = glm::dot(face.planeW, view.eyeW());
    const bool bothSides =
        settings_.backFaces || scene_.materials[scene_.objects[object].material].doubleSided;
    return side > 0.f || (bothSides && side < 0.f);
  }

  // The pixels of the part where the face may be seen.
  render::Window windowAround(const MirrorFace& face, const scene::View& view,
                              const Frustum& frustum, const render::Window& part) const {
    Polygon polygon(face.cornersW.begin(), face.cornersW.end());
    for (const vec4& plane : frustum.planes) polygon = clipped(polygon, plane);
    if (polygon.empty()) return {};
    vec2 low(std::numeric_limits<float>::infinity()), high(-low);
    for (const vec3& corner : polygon) {
      const vec4 clip = view.clipFromWorld() * vec4(corner, 1.f);
      const vec2 at = (0.5f + 0.5f * vec2(clip) / clip.w) * vec2(size_);
      low = glm::min(low, at);
      high = glm::max(high, at);
    }
    // Rounding takes less than a pixel off the frustum.
    const vec2 first(part.origin), end = first + vec2(part.size);
    return between(ivec2(glm::clamp(glm::floor(low) - 1.f, first, end)),
                   ivec2(glm::clamp(glm::ceil(high) + 1.f, first, end)));
  }

  // Faces of one plane share a picture.
  static void add(std::uint32_t object, const MirrorFace& face, const vec4& planeW,
                  const render::Window& seen, std::vector<Reflection>& reflections) {
    const float rounding = kRounding * largestCoordinate(face);
    const float size = glm::distance(face.cornersW[0], face.cornersW[2]);
    const auto farthest = [&](const vec4& plane) {
      float distance = 0.f;
      for (const vec3& corner : face.cornersW)
        distance = std::max(distance, std::abs(glm::dot(plane, vec4(corner, 1.f))));
      return distance;
    };
    auto same = std::ranges::find_if(reflections, [&](const Reflection& other) {
      return glm::dot(vec3(other.planeW), vec3(planeW)) > 0.999f &&
             farthest(other.planeW) <= kFlatness * size + rounding;
    });
    if (same == reflections.end()) {
      same = reflections.insert(same, Reflection());
      same->planeW = planeW;
    }
    Reflection& reflection = *same;
    if (reflection.mirrors.empty() || reflection.mirrors.back() != object)
      reflection.mirrors.push_back(object);
    reflection.clearance =
        std::max(reflection.clearance, face.unevenness + farthest(reflection.planeW) + rounding);
    reflection.tolerance = std::max(reflection.tolerance, reflection.clearance + kFlatness * size);
    reflection.part = around(reflection.part, seen);
  }

  // What is seen in the mirrors; the mirrors there wait.
  void follow(Reflection& reflection, const scene::View& view, int depth) {
    reflection.view = reflectedView(view, reflection.planeW, reflection.clearance, boundsW_);
    gpuScene_.bvh.query(render::frustumW(reflection.view, size_, reflection.part),
                        reflection.visible);
    if (depth == settings_.depth) return;
    reflection.within =
        reflectionsIn(reflection.view, reflection.part, mirrorsAmong(reflection.visible));
    wait(reflection.within, reflection.view, depth + 1);
  }

  const render::GpuScene& gpuScene_;
  const scene::Scene& scene_;
  uvec2 size_;
  ReflectionSettings settings_;
  Aabb boundsW_;
  std::map<std::uint32_t, std::vector<MirrorFace>> faces_;  // of objects
  std::vector<std::uint32_t> curved_;
  std::priority_queue<Waiting> waiting_;
  std::size_t found_ = 0, planned_ = 0;
};

}  // namespace

ReflectionPlan planReflections(const render::GpuScene& gpuScene, const render::ViewData& view,
                               std::span<const std::uint32_t> mirrors,
                               const ReflectionSettings& settings) {
  return Planner(gpuScene, view.size, settings).plan(view, mirrors);
}

}  // namespace lucerna::passes
