#include "bake/overlap.hpp"

#include <algorithm>
#include <array>
#include <tuple>

#include "bake/triangle.hpp"
#include "bake/weld.hpp"

namespace lucerna::bake {
namespace {

using Corners = std::array<glm::dvec3, 3>;

struct Edge {
  std::uint32_t from, to;  // welded, the lower first
  std::uint32_t triangle;  // place in the list
  std::uint32_t side;      // 0: from its corner 0 to 1, ...
  auto ends() const { return std::tuple(from, to); }
};

Corners cornersOf(const World& world, std::uint32_t triangle) {
  Corners corners;
  for (std::size_t k = 0; k < 3; ++k)
    corners[k] = world.positions[world.indices[3 * std::size_t{triangle} + k]];
  return corners;
}

std::vector<Edge> edgesOf(const World& world, std::span<const std::uint32_t> triangles) {
  const std::vector<std::uint32_t> welded = weld(world.positions);
  std::vector<Edge> edges;
  edges.reserve(3 * triangles.size());
  for (std::uint32_t i = 0; i < triangles.size(); ++i)
    for (std::uint32_t side = 0; side < 3; ++side) {
      const std::uint32_t* corners = &world.indices[3 * std::size_t{triangles[i]}];
      const std::uint32_t a = welded[corners[side]], b = welded[corners[(side + 1) % 3]];
      if (a != b) edges.push_back({std::min(a, b), std::max(a, b), i, side});
    }
  std::ranges::sort(edges, {},
                    [](const Edge& e) { return std::tuple(e.from, e.to, e.triangle, e.side); });
  return edges;
}

// From the edge to the corner that is not on it, across it: unit. NaN of a triangle without area.
glm::dvec3 inwards(const Corners& corners, std::uint32_t side) {
  const glm::dvec3 along = glm::normalize(corners[(side + 1) % 3] - corners[side]);
  const glm::dvec3 to = corners[(side + 2) % 3] - corners[side];
  return glm::normalize(to - along * glm::dot(along, to));
}

// v, moved so that its edges to a and b move outwards by so much, as far as they are to.
vec3 movedCorner(glm::dvec3 v, glm::dvec3 a, glm::dvec3 b, bool moveA, bool moveB, double by) {
  const glm::dvec3 fromA = glm::normalize(v - a), fromB = glm::normalize(v - b);
  constexpr double kLeastSine = 0.125;  // needles' tips go no farther than that
  const double sine = std::max(glm::length(glm::cross(fromA, fromB)), kLeastSine);
  const vec3 moved(v + (moveA ? by / sine : 0.) * fromB + (moveB ? by / sine : 0.) * fromA);
  return isFinite(moved) ? moved : vec3(v);
}

}  // namespace

std::vector<vec3> overlapping(const World& world, std::span<const std::uint32_t> triangles) {
  constexpr double kBent = 0.866;         // cosine
  constexpr std::size_t kMostTried = 32;  // triangles at an edge that the others are compared with
  std::vector<std::array<bool, 3>> moves(triangles.size());
  const std::vector<Edge> edges = edgesOf(world, triangles);
  std::vector<glm::dvec3> across;  // of the triangles at one edge
  for (std::size_t first = 0, end = 0; first < edges.size(); first = end) {
    across.clear();
    while (end < edges.size() && edges[end].ends() == edges[first].ends()) {
      across.push_back(inwards(cornersOf(world, triangles[edges[end].triangle]), edges[end].side));
      ++end;
    }
    // As in find_seams: copies of triangles in any number take no more time than that.
    const std::size_t tried = std::min(end, first + kMostTried);
    for (std::size_t i = first; i < end; ++i)
      for (std::size_t k = first; k < tried && !moves[edges[i].triangle][edges[i].side]; ++k)
        if (edges[i].triangle != edges[k].triangle &&
            glm::dot(across[i - first], across[k - first]) < -kBent)
          moves[edges[i].triangle][edges[i].side] = true;
  }
  std::vector<vec3> corners;
  corners.reserve(3 * triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const Corners c = cornersOf(world, triangles[i]);
    glm::dvec3 size(0.);
    for (const glm::dvec3& corner : c) size = glm::max(size, glm::abs(corner));
    const double by = std::max({size.x, size.y, size.z}) * 0x1p-22;
    for (std::size_t k = 0; k < 3; ++k)
      corners.push_back(movedCorner(c[k], c[(k + 1) % 3], c[(k + 2) % 3], moves[i][k],
                                    moves[i][(k + 2) % 3], by));
  }
  return corners;
}

}  // namespace lucerna::bake
