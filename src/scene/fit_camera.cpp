#include "scene/fit_camera.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>

#include "core/parallel.hpp"
#include "scene/extent.hpp"

namespace lucerna::scene {
namespace {

constexpr float kFovY = 0.9f;              // rad
constexpr float kWidestFrame = 4.f / 3.f;  // width / height that the box is fitted into
constexpr float kMargin = 1.05f;           // of distance
constexpr float kLowestRoom = 1.5f;        // m
constexpr float kNarrowestRoom = 0.01f;    // of the box's diagonal, from the middle to a wall
constexpr float kSameWall = 1e-4f;         // of distance: sheets closer than that are one
constexpr int kDirections = 16;            // around the horizon

// What a ray meets first, whatever the order in which it is told of surfaces.
struct Sight {
  float front = std::numeric_limits<float>::infinity();  // m to the nearest that faces the eye
  float back = std::numeric_limits<float>::infinity();   // and to the nearest that does not

  float distance() const { return std::min(front, back); }
  // A sheet modelled as two faces back to back is a wall.
  bool endsAtFront() const { return std::isfinite(front) && front <= (1.f + kSameWall) * back; }
  void merge(const Sight& other) {
    front = std::min(front, other.front);
    back = std::min(back, other.back);
  }
};
using Horizon = std::array<Sight, kDirections>;

vec3 direction(int i) {
  const float angle = 2.f * kPi * static_cast<float>(i) / kDirections;
  return {std::cos(angle), 0.f, std::sin(angle)};
}

// Moeller and Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection", 1997, for rays of one
// origin.
void look(Horizon& horizon, vec3 eye, const std::array<vec3, 3>& corners) {
  if ((corners[0].y > eye.y) == (corners[1].y > eye.y) &&
      (corners[0].y > eye.y) == (corners[2].y > eye.y))
    return;  // above or below the horizon
  const vec3 edge1 = corners[1] - corners[0];
  const vec3 edge2 = corners[2] - corners[0];
  const vec3 toEye = eye - corners[0];
  const vec3 q = glm::cross(toEye, edge1);
  const float distanceTimesDet = glm::dot(edge2, q);
  for (int i = 0; i < kDirections; ++i) {
    const vec3 ray = direction(i);
    const vec3 p = glm::cross(ray, edge2);
    const float det = glm::dot(edge1, p);
    if (det == 0.f) continue;
    const float u = glm::dot(toEye, p) / det;
    const float v = glm::dot(ray, q) / det;
    const float distance = distanceTimesDet / det;
    if (u < 0.f || v < 0.f || u + v > 1.f || distance <= 0.f) continue;
    float& nearest = det > 0.f ? horizon[i].front : horizon[i].back;
    nearest = std::min(nearest, distance);
  }
}

Horizon lookAround(const Scene& scene, vec3 eye) {
  Horizon horizon;
  std::mutex mutex;
  for (const Object& object : scene.objects) {
    if (object.boundsW.min.y > eye.y || object.boundsW.max.y < eye.y) continue;
    const Mesh& mesh = scene.meshes[object.mesh];
    const mat4& worldFromObject = scene.nodes[object.node].worldFromNode;
    parallelFor(mesh.triangleCount(), 1u << 16, [&](std::size_t begin, std::size_t end) {
      Horizon own;
      for (std::size_t t = begin; t < end; ++t) {
        std::array<vec3, 3> corners;
        for (std::size_t k = 0; k < 3; ++k)
          corners[k] = vec3(worldFromObject * vec4(mesh.positions[mesh.indices[3 * t + k]], 1.f));
        look(own, eye, corners);
      }
      const std::lock_guard lock(mutex);
      for (int i = 0; i < kDirections; ++i) horizon[i].merge(own[i]);
    });
  }
  return horizon;
}

// Looks along `ahead`, not straight up or down. Outputs narrower than `frame` (width / height) keep
// its width.
void addCamera(Scene& scene, vec3 eye, vec3 ahead, float frame) {
  Camera camera;
  camera.name = "default";
  camera.fovY = kFovY;
  camera.aspect = frame;
  // Far from the origin, eye + ahead may be the eye.
  mat4 place = glm::inverse(glm::lookAt(vec3(0.f), ahead, vec3(0.f, 1.f, 0.f)));
  place[3] = vec4(eye, 1.f);
  camera.node = addNode(scene, "default camera", place);
  scene.cameras.push_back(camera);
}

// From the nearest eye in the given direction from the box's centre that sees all eight corners.
void addCameraOutside(Scene& scene, const Aabb& box, vec3 toEye) {
  const vec3 right = glm::normalize(glm::cross(vec3(0.f, 1.f, 0.f), toEye));
  const vec3 up = glm::cross(toEye, right);
  const float tanY = std::tan(0.5f * kFovY);
  const float tanX = tanY * kWidestFrame;
  std::array<vec3, 8> corners;  // right, up and towards the eye of the box's centre
  float distance = 1e-3f;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const vec3 sign((i & 1) ? 1.f : -1.f, (i & 2) ? 1.f : -1.f, (i & 4) ? 1.f : -1.f);
    const vec3 corner = 0.5f * sign * box.extent();
    corners[i] = {glm::dot(corner, right), glm::dot(corner, up), glm::dot(corner, toEye)};
    const float needed = std::max(std::abs(corners[i].x) / tanX, std::abs(corners[i].y) / tanY);
    distance = std::max(distance, kMargin * (needed + corners[i].z));
  }
  float frame = 0.f;  // as wide as the box looks
  for (const vec3& corner : corners)
    frame = std::max(frame, std::abs(corner.x) / (distance - corner.z) / tanY);
  addCamera(scene, box.center() + toEye * distance, -toEye, kMargin * frame);
}

}  // namespace

void addFittingCamera(Scene& scene) {
  const Aabb box = scene.boundsW();
  const auto lost = std::count_if(scene.objects.begin(), scene.objects.end(), [](const Object& o) {
    return !o.boundsW.empty() && !withinReach(o.boundsW);
  });
  if (lost > 0)
    scene.warnings.push_back(
        fmt::format("{} of {} objects lie so far away that no camera can show them with the rest; "
                    "the default camera leaves them out",
                    lost, scene.objects.size()));
  if (box.empty()) return addCamera(scene, vec3(0.f, 1.f, 3.f), -vec3(0.f, 1.f, 3.f), 0.f);

  // A room: from its middle most sight lines end at the front of a wall; from the middle of a solid
  // thing they end at back faces. A car has an inside too, but none to stand in; nor is a
  // gap between the things of a wide field a room.
  vec3 eye = box.center();
  eye.y = box.min.y + 0.3f * box.extent().y;
  const Horizon horizon = lookAround(scene, eye);
  const auto walls = std::count_if(horizon.begin(), horizon.end(), [&](const Sight& sight) {
    return sight.endsAtFront() && sight.distance() > kNarrowestRoom * box.diagonal();
  });
  if (walls < kDirections * 3 / 4 || box.extent().y < kLowestRoom)
    return addCameraOutside(scene, box, glm::normalize(vec3(0.5f, 0.45f, 1.f)));

  // Along the longest free line through the middle, from near its one end.
  int best = 0;
  float longest = 0.f;
  for (int i = 0; i < kDirections / 2; ++i) {
    const float behind = horizon[i + kDirections / 2].distance();
    const float length = std::min(horizon[i].distance() + behind, box.diagonal());
    if (length > longest) {
      longest = length;
      best = i;
    }
  }
  const float back = std::min(horizon[best].distance(), box.diagonal());
  eye += direction(best) * (0.8f * back);
  addCamera(scene, eye, -direction(best), 1.f);
}

}  // namespace lucerna::scene
