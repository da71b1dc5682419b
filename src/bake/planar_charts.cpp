#include "bake/planar_charts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <numeric>
#include <set>
#include <utility>

#include "bake/smallest_rectangle.hpp"
#include "bake/triangle.hpp"
#include "bake/weld.hpp"

namespace lucerna::bake {
namespace {

struct Triangle {
  std::array<std::uint32_t, 3> corners{};  // as weld() numbers them
  vec3 normal{0.f};                        // unit; 0 of degenerate ones
  float area = 0.f;
};

// Of a triangle: from a corner to the next, counter-clockwise.
struct Side {
  std::uint32_t from = 0, to = 0, triangle = 0;
  auto operator<=>(const Side&) const = default;
};

// Of the sides that very many triangles share, so many are tried.
constexpr std::size_t kMostTried = 32;

// What grows charts over a mesh.
class Grower {
 public:
  Grower(std::span<const vec3> positions, std::span<const std::uint32_t> indices,
         const PlanarSettings& settings)
      : positions_(positions), settings_(settings), chartOf_(indices.size() / 3, kNone) {
    const std::vector<std::uint32_t> numbers = weld(positions);
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
      const auto [normal, area] =
          shapeOf({positions[indices[i]], positions[indices[i + 1]], positions[indices[i + 2]]});
      const Triangle triangle{
          .corners = {numbers[indices[i]], numbers[indices[i + 1]], numbers[indices[i + 2]]},
          .normal = normal,
          .area = area};
      triangles_.push_back(triangle);
      const auto number = static_cast<std::uint32_t>(i / 3);
      if (triangle.area > 0.f)
        for (const auto& [from, to] : endsOf(number)) sides_.push_back({from, to, number});
    }
    std::ranges::sort(sides_);
    firstFree_.resize(sides_.size());
    std::iota(firstFree_.begin(), firstFree_.end(), std::size_t{0});
  }

  PlanarCharts grow() {
    PlanarCharts result;
    std::vector<std::uint32_t> seeds(triangles_.size());
    std::iota(seeds.begin(), seeds.end(), 0u);
    std::ranges::stable_sort(seeds, [&](std::uint32_t a, std::uint32_t b) {
      return triangles_[a].area > triangles_[b].area;
    });
    for (const std::uint32_t seed : seeds)
      if (triangles_[seed].area <= 0.f)
        result.degenerate.push_back(seed);
      else if (chartOf_[seed] == kNone)
        result.charts.push_back(chartFrom(seed, static_cast<std::uint32_t>(result.charts.size())));
    return result;
  }

 private:
  static constexpr std::uint32_t kNone = 0xffffffffu;
  using Ends = std::pair<std::uint32_t, std::uint32_t>;  // of a side

  std::array<Ends, 3> endsOf(std::uint32_t triangle) const {
    const auto& c = triangles_[triangle].corners;
    return {{{c[0], c[1]}, {c[1], c[2]}, {c[2], c[0]}}};
  }

  PlanarChart chartFrom(std::uint32_t seed, std::uint32_t number) {
    PlanarChart chart;
    chart.normal = triangles_[seed].normal;
    taken_.clear();
    take(chart, number, seed);
    const vec3 onPlane = positions_[triangles_[seed].corners[0]];
    for (std::size_t next = 0; next < chart.triangles.size(); ++next)
      for (const Ends& side : endsOf(chart.triangles[next]))
        takeAcross(chart, number, onPlane, side);
    std::ranges::sort(chart.triangles);
    layFlat(chart);
    return chart;
  }

  // Takes the first that goes on beyond a side of the chart's: what does runs the other way there.
  void takeAcross(PlanarChart& chart, std::uint32_t number, vec3 onPlane, const Ends& side) {
    const auto first = static_cast<std::size_t>(
        std::ranges::lower_bound(sides_, Side{side.second, side.first, 0}) - sides_.begin());
    const auto isThere = [&](std::size_t i) {
      return i < sides_.size() && sides_[i].from == side.second && sides_[i].to == side.first;
    };
    if (!isThere(first)) return;
    std::size_t& free = firstFree_[first];
    while (isThere(free) && chartOf_[sides_[free].triangle] != kNone) ++free;
    for (std::size_t i = free; isThere(i) && i < free + kMostTried; ++i) {
      const std::uint32_t other = sides_[i].triangle;
      if (chartOf_[other] == kNone && liesIn(chart, onPlane, other) && take(chart, number, other))
        return;
    }
  }

  bool liesIn(const PlanarChart& chart, vec3 onPlane, std::uint32_t triangle) const {
    const Triangle& t = triangles_[triangle];
    return glm::dot(t.normal, chart.normal) >= settings_.cosNormal &&
           std::ranges::all_of(t.corners, [&](std::uint32_t corner) {
             return std::abs(glm::dot(positions_[corner] - onPlane, chart.normal)) <=
                    settings_.offPlane;
           });
  }

  // Takes a triangle into the chart that is grown. Of its sides, which all run counter-clockwise,
  // none may run as one of the chart's does: there it would lie, like a copy, on what is there
  // already.
  bool take(PlanarChart& chart, std::uint32_t number, std::uint32_t triangle) {
    const std::array<Ends, 3> sides = endsOf(triangle);
    if (std::ranges::any_of(sides, [&](const Ends& side) { return taken_.contains(side); }))
      return false;
    taken_.insert(sides.begin(), sides.end());
    chartOf_[triangle] = number;
    chart.triangles.push_back(triangle);
    return true;
  }

  // In the smallest rectangle around it.
  void layFlat(PlanarChart& chart) const;

  std::span<const vec3> positions_;
  PlanarSettings settings_;
  std::vector<Triangle> triangles_;
  std::vector<Side> sides_;             // sorted
  std::vector<std::size_t> firstFree_;  // of the first of equal sides: those before it are taken
  std::vector<std::uint32_t> chartOf_;
  std::set<Ends> taken_;  // of the chart that is grown
};

void Grower::layFlat(PlanarChart& chart) const {
  const glm::dvec3 normal(chart.normal),
      base(positions_[triangles_[chart.triangles[0]].corners[0]]);
  const glm::dvec3 u0 =
      glm::normalize(std::abs(normal.y) < 0.8 ? glm::dvec3(normal.z, 0, -normal.x)
                                              : glm::dvec3(0, -normal.z, normal.y));
  const glm::dvec3 v0 = glm::cross(normal, u0);
  std::vector<glm::dvec2> points;
  for (const std::uint32_t triangle : chart.triangles)
    for (const std::uint32_t corner : triangles_[triangle].corners) {
      const glm::dvec3 p = glm::dvec3(positions_[corner]) - base;
      points.emplace_back(glm::dot(p, u0), glm::dot(p, v0));
    }
  const Rectangle around = smallestRectangle(std::move(points));
  const glm::dvec2 along = around.along, across = around.across();
  chart.alongU = vec3(along.x * u0 + along.y * v0);
  chart.alongV = vec3(across.x * u0 + across.y * v0);
  chart.origin = vec3(base + around.corner.x * u0 + around.corner.y * v0);
  chart.size = vec2(around.size);
}

}  // namespace

PlanarCharts planarCharts(std::span<const vec3> positions, std::span<const std::uint32_t> indices,
                          const PlanarSettings& settings) {
  return Grower(positions, indices, settings).grow();
}

}  // namespace lucerna::bake
