#include "lightmap/chart_texels.hpp"

namespace lucerna::lightmap {
namespace {

double areaOf(const std::array<vec2, 3>& c) {
  const glm::dvec2 u = c[1] - c[0], v = c[2] - c[0];
  return 0.5 * std::abs(u.x * v.y - u.y * v.x);
}

double worldArea(const scene::Scene& scene, const scene::Object& object, std::size_t triangle) {
  const scene::Mesh& mesh = scene.meshes[object.mesh];
  const mat4& worldFromNode = scene.nodes[object.node].worldFromNode;
  std::array<glm::dvec3, 3> p;
  for (std::size_t k = 0; k < 3; ++k)
    p[k] = vec3(worldFromNode * vec4(mesh.positions[mesh.indices[3 * triangle + k]], 1.f));
  return 0.5 * glm::length(glm::cross(p[1] - p[0], p[2] - p[0]));
}

}  // namespace

bool ChartTexels::isBeside(int x, int y) const {
  if (at(x, y) != kNothing) return false;
  for (int dy = -1; dy <= 1; ++dy)
    for (int dx = -1; dx <= 1; ++dx)
      if (at(x + dx, y + dy) != kNothing) return true;
  return false;
}

bool ChartTexels::isBorder(int x, int y) const {
  const std::uint32_t own = at(x, y);
  if (own == kNothing) return false;
  return at(x - 1, y) != own || at(x + 1, y) != own || at(x, y - 1) != own || at(x, y + 1) != own;
}

ChartTexels chartTexels(const Layout& layout, int map) {
  ChartTexels texels{.side = layout.side, .charts = {}, .overlaps = {}};
  const auto side = static_cast<std::size_t>(layout.side);
  texels.charts.assign(side * side, ChartTexels::kNothing);
  for (const auto& triangles : layout.objects)
    for (const TrianglePlace& place : triangles) {
      if (place.map != map) continue;
      forEachTexel(place.corners, layout.side, [&](int x, int y) {
        const std::size_t at = static_cast<std::size_t>(y) * side + static_cast<std::size_t>(x);
        std::uint32_t& chart = texels.charts[at];
        if (chart == ChartTexels::kNothing)
          chart = place.chart;
        else if (chart != place.chart)
          texels.overlaps.push_back(static_cast<std::uint32_t>(at));
      });
    }
  std::ranges::sort(texels.overlaps);
  const auto twice = std::ranges::unique(texels.overlaps);
  texels.overlaps.erase(twice.begin(), twice.end());
  return texels;
}

std::vector<std::vector<float>> densities(const Layout& layout, const scene::Scene& scene) {
  std::vector<std::vector<float>> result(layout.objects.size());
  for (std::size_t i = 0; i < layout.objects.size(); ++i)
    for (std::size_t k = 0; k < layout.objects[i].size(); ++k) {
      const TrianglePlace& place = layout.objects[i][k];
      const double area = worldArea(scene, scene.objects[i], k);
      const bool has = place.map != TrianglePlace::kNowhere && area > 0.;
      result[i].push_back(has ? static_cast<float>(std::sqrt(areaOf(place.corners) / area)) : 0.f);
    }
  return result;
}

}  // namespace lucerna::lightmap
