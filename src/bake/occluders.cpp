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

Occluders::Occluders(const World& world) : world_(world) {
  std::vector<Aabb> boxes(world.triangleCount());
  for (std::size_t i = 0; i < boxes.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) boxes[i].grow(world.positions[world.indices[3 * i + k]]);
  bvh_.build(boxes);
}

bool Occluders::anyIn(const Shaft& shaft) const {
  const auto nodes = bvh_.nodes();
  if (nodes.empty()) return false;
  std::array<std::uint32_t, 128> stack;
  std::size_t depth = 0;
  stack[depth++] = 0;
  while (depth > 0) {
    const scene::Bvh::Node& node = nodes[stack[--depth]];
    if (!shaft.mayMeet(node.box)) continue;
    if (node.count == 0) {
      if (depth + 2 > stack.size()) return true;  // deeper than any tree that is built
      stack[depth++] = node.first + 1;
      stack[depth++] = node.first;
      continue;
    }
    for (std::uint32_t i = 0; i < node.count; ++i) {
      const std::size_t triangle = bvh_.items()[node.first + i];
      const auto corner = [&](std::size_t k) {
        return world_.positions[world_.indices[3 * triangle + k]];
      };
      if (shaft.mayMeet(std::array{corner(0), corner(1), corner(2)})) return true;
    }
  }
  return false;
}

}  // namespace lucerna::bake
