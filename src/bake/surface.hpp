// A soup of triangles as surfaces: what lies across each side of a triangle.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "bake/triangle.hpp"
#include "core/math/math.hpp"

namespace lucerna::bake {

// Each side has at most one other across it, which runs the other way: what is left is a manifold
// with an orientation, whatever the mesh is. Side 3 * t + k of triangle t runs from its corner k to
// the next.
struct Surface {
  static constexpr std::uint32_t kNone = 0xffffffffu;
  std::vector<std::array<vec3, 3>> corners;  // of each triangle
  std::vector<TriangleShape> shapes;    // area 0: degenerate, and nothing lies across its sides
  std::vector<std::uint32_t> across;    // of each side, or kNone
  std::vector<std::uint32_t> flatPart;  // of each triangle: its planar chart, or kNone
  std::vector<vec3> flatNormals;        // of each planar chart

  std::size_t triangles() const { return corners.size(); }
};

// indices: three a triangle, of positions. Where several sides could be joined, those of one planar
// chart are, then those with the least angle between the normals. Copies of a triangle are
// joined with copies, not with what the first is joined with.
Surface surfaceOf(std::span<const vec3> positions, std::span<const std::uint32_t> indices);

}  // namespace lucerna::bake
