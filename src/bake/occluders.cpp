#include "bake/occluders.hpp"

#include <algorithm>

#include "core/check.hpp"

namespace lucerna::bake {
namespace {

// Of a direction along the plane: unit.
vec4 planeThrough(vec3 p, vec3 normal, float outward) {
  return {normal, outward - glm::dot(normal, p)};
}

// Rounding errors of places of this size.
float roundingAt(const Aabb& box) {
  const vec3 size = glm::max(glm::abs(box.min), glm::abs(box.max));
  return std::max({size.x, size.y, size.z, 0.1f}) * 0x1p-20f;
}

}  // namespace

bool Shaft::mayMeet(const Aabb& box) const {
  const vec3 centre = box.center(), half = 0.5f * box.extent();
  return std::all_of(planes_.begin(), planes_.begin() + static_cast<std::ptrdiff_t>(count_),
                     [&](const vec4& plane) {
                       const vec3 n(plane);
                       return glm::dot(n, centre) + glm::dot(glm::abs(n), half) + plane.w >= 0.f;
                     });
}

bool Shaft::mayMeet(const std::array<vec3, 3>& triangle) const {
  return std::all_of(planes_.begin(), planes_.begin() + static_cast<std::ptrdiff_t>(count_),
                     [&](const vec4& plane) {
                       return std::ranges::any_of(triangle, [&](vec3 p) {
                         return glm::dot(vec3(plane), p) + plane.w >= 0.f;
                       });
                     });
}

Shaft shaftFrom(vec3 centreW, float radius, const Samples& block) {
  CHECK(block.planar);
  Shaft shaft;
  Aabb all = block.boundsW;
  all.grow(centreW);
  const float rounding = roundingAt(all);  // planes lead from the block to the light
  // What lies in the surface's own plane is below the samples, which are clear of it.
  shaft.add(planeThrough(block.corners[0], block.axis, roundingAt(block.boundsW)));
  const vec3 middle =
      0.25f * (block.corners[0] + block.corners[1] + block.corners[2] + block.corners[3]);
  for (std::size_t i = 0; i < 4; ++i) {
    const vec3 a = block.corners[i], b = block.corners[(i + 1) % 4];
    const vec3 n = glm::cross(b - a, centreW - a);
    const float length = glm::length(n);
    if (!(length > 0.f)) continue;  // the light lies on the edge's line: no plane is needed
    const vec3 inward = glm::dot(n, middle - a) < 0.f ? -n / length : n / length;
    shaft.add(planeThrough(a, inward, radius + rounding));
  }
  // Behind the light, seen from the block.
  const vec3 back = middle - centreW;
  const float distance = glm::length(back);
  float least = 0.f;  // of the corners along it, for blocks that reach behind the light
  const vec3 n = distance > 0.f ? back / distance : block.axis;
  for (const vec3 corner : block.corners) least = std::min(least, glm::dot(n, corner - centreW));
  shaft.add(planeThrough(centreW, n, radius - least + rounding));
  return shaft;
}

Shaft shaftAlong(vec3 toLightW, float sine, float length, const Samples& block) {
  CHECK(block.planar);
  Shaft shaft;
  shaft.add(planeThrough(block.corners[0], block.axis, roundingAt(block.boundsW)));
  const float rounding = roundingAt(block.boundsW) + length * 0x1p-20f;
  const vec3 middle =
      0.25f * (block.corners[0] + block.corners[1] + block.corners[2] + block.corners[3]);
  for (std::size_t i = 0; i < 4; ++i) {
    const vec3 a = block.corners[i], b = block.corners[(i + 1) % 4];
    const vec3 n = glm::cross(b - a, toLightW);
    const float size = glm::length(n);
    if (!(size > 0.f)) continue;
    const vec3 inward = glm::dot(n, middle - a) < 0.f ? -n / size : n / size;
    shaft.add(planeThrough(a, inward, sine * length + rounding));
  }
  return shaft;
}

Shaft slabAround(const Samples& samples, const Samples::Tile& tile, const Aabb& box) {
  Shaft shaft;
  for (int axis = 0; axis < 3; ++axis) {
    vec3 n(0.f);
    n[axis] = 1.f;
    shaft.add({n, -box.min[axis]});
    shaft.add({-n, box.max[axis]});
  }
  if (!samples.planar) return shaft;
  // What lies in the surface's own plane is half the samples' height below the slab.
  const vec3 p = tile.boundsW.center();
  const float half = 0.5f * liftAt(samples.boundsW.center());
  shaft.add(planeThrough(p, samples.axis, half));
  shaft.add(planeThrough(p, -samples.axis, half));
  return shaft;
}

Occluders::Occluders(const World& world) : world_(world) {
  std::vector<Aabb> boxes(world.triangleCount());
  for (std::size_t i = 0; i < boxes.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) boxes[i].grow(world.positions[world.indices[3 * i + k]]);
  bvh_.build(boxes);
}

std::array<vec3, 3> Occluders::cornersOf(std::uint32_t triangle) const {
  const std::uint32_t* corners = &world_.indices[3 * std::size_t{triangle}];
  return {world_.positions[corners[0]], world_.positions[corners[1]], world_.positions[corners[2]]};
}

bool Occluders::anyIn(const Shaft& shaft) const {
  return anyIn(shaft, [](std::uint32_t) { return true; });
}

}  // namespace lucerna::bake
