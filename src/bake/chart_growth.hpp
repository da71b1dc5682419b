// Which triangles of a surface become a chart: greedy merging of neighbours by how little they bend
// (Garland, Willmott and Heckbert, "Hierarchical Face Clustering on Polygonal Surfaces", 2001, with
// the measure of Cohen-Steiner, Alliez and Desbrun, "Variational Shape Approximation", 2004),
// within a cone of normals.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bake/surface.hpp"

namespace lucerna::bake {

struct GrowthSettings {
  float crease = 0.7f;   // rad: no parts are merged over edges that bend more
  float cone = 0.9f;     // rad: the most between an axis and the normals; below pi / 2
  float compact = 6.f;   // perimeter^2 / (4 pi area) that merging may reach
  float longest = 1e9f;  // m: the most of the diagonal of the box around merged parts
};

// Triangles that are joined. All normals lie within `cone` (rad) of the axis (unit).
struct Region {
  std::vector<std::uint32_t> triangles;  // in rising order
  glm::dvec3 axis{0};
  double cone = 0;
};

// The cone of some triangles around `axis`.
double coneAround(glm::dvec3 axis, const Surface& surface,
                  std::span<const std::uint32_t> triangles);

// Of all triangles that have an area, by their first triangles. Flat parts stay whole.
std::vector<Region> growRegions(const Surface& surface, const GrowthSettings& settings);

}  // namespace lucerna::bake
