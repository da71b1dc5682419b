#include "app/bench/cameras.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/random.hpp"
#include "trace/ray_scene.hpp"

namespace lucerna::app::bench {
namespace {

constexpr float kFovY = 0.87f;  // rad
constexpr int kAcross = 16, kDown = 12;
constexpr float kLowest = -0.44f, kHighest = 0.17f;  // rad, of the view's axis
// Distances to what is looked at: of the diagonals of its object and of the whole box.
constexpr float kNearest = 0.05f, kFarthest = 0.4f, kOfObject = 8.f;
// After this many refusals in a row less is asked for; in the end, anything.
constexpr int kPatience = 48;
constexpr float kLessStrict = 0.85f, kGivesUp = 0.01f;

struct Sight {
  float covered = 0.f;  // share of the rays that meet something
  float inside = 0.f;   // of these, the share that meets a surface from behind
  float near = 0.f, median = 0.f, far = 0.f;  // m: tenth, half and nine tenths of them are nearer
};

// What all that is asked for is scaled by: 1 at first, then less.
bool showsSomething(const Sight& sight, float diagonal, float strictness) {
  return sight.covered >= 0.7f * strictness && sight.inside <= 0.02f / strictness &&
         sight.median >= 0.02f * diagonal * strictness &&
         sight.near >= 0.1f * sight.median * strictness &&
         sight.far >= (1.f + 0.3f * strictness) * sight.near;
}

std::vector<trace::Ray> raysOf(const CameraPose& pose) {
  const mat4 worldFromView = worldFromCamera(pose);
  const float tanY = std::tan(0.5f * pose.fovY), tanX = tanY * kAcross / kDown;
  std::vector<trace::Ray> rays;
  for (int y = 0; y < kDown; ++y)
    for (int x = 0; x < kAcross; ++x) {
      const vec2 ndc = (vec2(x, y) + 0.5f) / vec2(kAcross, kDown) * 2.f - 1.f;
      const vec4 directionV(ndc.x * tanX, ndc.y * tanY, -1.f, 0.f);
      rays.push_back({.originW = pose.position,
                      .directionW = glm::normalize(vec3(worldFromView * directionV))});
    }
  return rays;
}

std::optional<Sight> look(const trace::RayScene& rayScene, const CameraPose& pose) {
  const std::vector<trace::Ray> rays = raysOf(pose);
  std::vector<trace::Hit> hits(rays.size());
  rayScene.closest(rays, hits);
  std::vector<float> distances;
  int behind = 0;
  const trace::MaterialLookup& lookup = rayScene.lookup();
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (!hits[i].any()) continue;
    distances.push_back(hits[i].t);
    const trace::Spot& spot = hits[i].spot;
    if (!lookup.materialOf(spot.object).doubleSided &&
        !lookup.frontFacing(spot, rays[i].directionW))
      ++behind;
  }
  if (distances.empty()) return std::nullopt;
  std::ranges::sort(distances);
  const auto count = static_cast<float>(distances.size());
  const auto at = [&](float share) { return distances[static_cast<std::size_t>(share * count)]; };
  return Sight{.covered = count / static_cast<float>(rays.size()),
               .inside = static_cast<float>(behind) / count,
               .near = at(0.1f),
               .median = at(0.5f),
               .far = at(0.9f)};
}

// What cameras may look at: a scene, what its rays meet, and which of its objects have surfaces.
class Surroundings {
 public:
  explicit Surroundings(const scene::Scene& scene)
      : scene_(scene), rays(scene, mat4(1.f)), box(scene.boundsW()) {
    for (const scene::Object& object : scene.objects)
      if (scene.meshes[object.mesh].triangleCount() > 0) objects_.push_back(&object);
  }
  bool empty() const { return objects_.empty(); }

  // A corner of a triangle of any object, so that what has many parts is looked at often.
  std::pair<const scene::Object*, vec3> target(Random& random) const {
    const scene::Object& object =
        *objects_[random.below(static_cast<std::uint32_t>(objects_.size()))];
    const scene::Mesh& mesh = scene_.meshes[object.mesh];
    const std::uint32_t corner =
        mesh.indices[random.below(static_cast<std::uint32_t>(mesh.indices.size()))];
    return {&object,
            vec3(scene_.nodes[object.node].worldFromNode * vec4(mesh.positions[corner], 1.f))};
  }

  // The nearest surface from there, m; infinity if there is none.
  float distance(vec3 eye, vec3 direction) const {
    const trace::Ray ray{.originW = eye, .directionW = direction};
    trace::Hit hit;
    rays.closest({&ray, 1}, {&hit, 1});
    return hit.t;
  }

 private:
  const scene::Scene& scene_;
  std::vector<const scene::Object*> objects_;

 public:
  const trace::RayScene rays;
  const Aabb box;
};

bool contains(const Aabb& box, vec3 point) {
  return glm::all(glm::greaterThanEqual(point, box.min)) &&
         glm::all(glm::lessThanEqual(point, box.max));
}

// Above the ground under the open sky at that place, if it is the scene's lowest.
std::optional<vec3> standing(const Surroundings& around, vec3 place, float eyeHeight) {
  const float sky = around.box.max.y + eyeHeight;
  const float ground = sky - around.distance({place.x, sky, place.z}, {0.f, -1.f, 0.f});
  if (!(ground <= around.box.min.y + eyeHeight)) return std::nullopt;
  return vec3(place.x, ground + eyeHeight, place.z);
}

// A random eye that sees a random target.
std::optional<CameraPose> candidate(const Surroundings& around, float eyeHeight, Random& random) {
  const auto [object, target] = around.target(random);
  const float diagonal = around.box.diagonal();
  const float farthest = std::min(kFarthest * diagonal, kOfObject * object->boundsW.diagonal());
  const float nearest = std::min(kNearest * diagonal, 0.5f * farthest);
  const float distance = nearest * std::pow(farthest / nearest, random.uniform());
  const float yaw = random.uniform(0.f, 2.f * kPi);
  const float pitch = random.uniform(kLowest, kHighest);
  vec3 eye = target - distance * vec3(std::cos(pitch) * std::sin(yaw), std::sin(pitch),
                                      std::cos(pitch) * std::cos(yaw));
  if (eyeHeight > 0.f) {
    const auto onTheGround = standing(around, eye, eyeHeight);
    if (!onTheGround) return std::nullopt;
    eye = *onTheGround;
  }
  if (!contains(around.box, eye) || eye == target) return std::nullopt;
  const vec3 ahead = glm::normalize(target - eye);
  const bool level = ahead.y >= std::sin(kLowest) && ahead.y <= std::sin(kHighest);
  if (!level || around.distance(eye, ahead) < 0.99f * glm::distance(eye, target))
    return std::nullopt;
  return CameraPose{.position = eye, .target = target, .fovY = kFovY};
}

SeededCamera fromOutside(const Aabb& box) {
  const float distance = std::max(box.diagonal(), 1e-3f);
  const vec3 centre = box.empty() ? vec3(0.f) : box.center();
  return {.pose = {.position = centre + vec3(0.f, 0.f, distance), .target = centre, .fovY = kFovY},
          .sight = distance};
}

SeededCamera findCamera(const Surroundings& around, float eyeHeight, Random random) {
  for (float strictness = 1.f; strictness > kGivesUp; strictness *= kLessStrict)
    for (int i = 0; i < kPatience; ++i) {
      const auto pose = candidate(around, eyeHeight, random);
      if (!pose) continue;
      const auto sight = look(around.rays, *pose);
      if (sight && showsSomething(*sight, around.box.diagonal(), strictness))
        return {.pose = *pose, .sight = sight->median};
    }
  return fromOutside(around.box);
}

}  // namespace

std::vector<SeededCamera> seededCameras(const scene::Scene& scene, const CameraWish& wish) {
  const Surroundings around(scene);
  std::vector<SeededCamera> cameras;
  for (int i = 0; i < wish.count; ++i)
    cameras.push_back(
        around.empty()
            ? fromOutside(around.box)
            : findCamera(around, wish.eyeHeight, Random(wish.seed, static_cast<std::uint64_t>(i))));
  return cameras;
}

std::vector<SeededCamera> ownCameras(const scene::Scene& scene, int most) {
  std::vector<SeededCamera> cameras;
  for (const scene::Camera& camera : scene.cameras) {
    if (static_cast<int>(cameras.size()) == most) break;
    const mat4& worldFromNode = scene.nodes[camera.node].worldFromNode;
    const vec3 position(worldFromNode[3]);
    cameras.push_back({.pose = {.position = position,
                                .target = position - glm::normalize(vec3(worldFromNode[2])),
                                .up = vec3(worldFromNode[1]),
                                .fovY = camera.fovY,
                                .near = camera.near,
                                .far = camera.far}});
  }
  return cameras;
}

CameraPath pathThrough(std::span<const SeededCamera> cameras) {
  std::vector<CameraPose> rest, poses;
  for (const SeededCamera& camera : cameras) rest.push_back(camera.pose);
  CHECK(!rest.empty());
  poses.push_back(rest.front());
  rest.erase(rest.begin());
  while (!rest.empty()) {
    const auto nearest = std::ranges::min_element(rest, {}, [&](const CameraPose& pose) {
      return glm::distance(pose.position, poses.back().position);
    });
    poses.push_back(*nearest);
    rest.erase(nearest);
  }
  return CameraPath::through(poses);
}

}  // namespace lucerna::app::bench
