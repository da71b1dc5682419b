#include "bake/curved_charts.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <optional>
#include <utility>
#include <variant>

#include "bake/chart_overlap.hpp"
#include "bake/smallest_rectangle.hpp"
#include "bake/stretch.hpp"
#include "bake/unfold.hpp"
#include "core/parallel.hpp"

namespace lucerna::bake {
namespace {

constexpr double kNearlyFlat = 0.09;  // rad: a cone of normals that a projection stretches by 0.4 %
constexpr double kTouch = 2e-5;       // of a chart's longer side: less is no overlap
constexpr std::size_t kRegionsAtOnce = 16;  // that a thread takes

// A region by itself.
struct Cut {
  Piece piece;
  std::vector<std::uint32_t> across;  // of each side, or Surface::kNone
};

std::vector<std::uint32_t> acrossIn(const Region& region, const Surface& surface) {
  std::vector<std::uint32_t> across(3 * region.triangles.size(), Surface::kNone);
  for (std::uint32_t i = 0; i < across.size(); ++i) {
    const std::uint32_t other = surface.across[3 * region.triangles[i / 3] + i % 3];
    if (other == Surface::kNone) continue;
    const auto place = std::ranges::lower_bound(region.triangles, other / 3);
    if (place != region.triangles.end() && *place == other / 3)
      across[i] = static_cast<std::uint32_t>(3 * (place - region.triangles.begin())) + other % 3;
  }
  return across;
}

// Of each corner the first that is the same point. Points are what sides join, so that where parts
// only touch by a point there are two.
std::vector<std::uint32_t> firstCorners(std::span<const std::uint32_t> across) {
  std::vector<std::uint32_t> first(across.size());
  std::iota(first.begin(), first.end(), 0u);
  const auto firstOf = [&](std::uint32_t i) {
    while (first[i] != i) i = first[i] = first[first[i]];
    return i;
  };
  const auto unite = [&](std::uint32_t a, std::uint32_t b) {
    a = firstOf(a), b = firstOf(b);
    first[std::max(a, b)] = std::min(a, b);
  };
  const auto end = [](std::uint32_t side) { return side % 3 == 2 ? side - 2 : side + 1; };
  for (std::uint32_t i = 0; i < across.size(); ++i)
    if (const std::uint32_t other = across[i]; other != Surface::kNone && i < other)
      unite(i, end(other)), unite(end(i), other);
  for (std::uint32_t i = 0; i < across.size(); ++i) first[i] = firstOf(i);
  return first;
}

Cut cutOut(const Surface& surface, const Region& region) {
  Cut cut{.piece = {}, .across = acrossIn(region, surface)};
  const std::vector<std::uint32_t> first = firstCorners(cut.across);
  std::vector<std::uint32_t> pointOf(first.size());
  cut.piece.triangles.resize(region.triangles.size());
  const glm::dvec3 base(surface.corners[region.triangles[0]][0]);
  for (std::uint32_t i = 0; i < first.size(); ++i) {
    if (first[i] == i) {
      pointOf[i] = static_cast<std::uint32_t>(cut.piece.points.size());
      cut.piece.points.push_back(glm::dvec3(surface.corners[region.triangles[i / 3]][i % 3]) -
                                 base);
    }
    cut.piece.triangles[i / 3][i % 3] = pointOf[first[i]];
  }
  return cut;
}

std::vector<glm::dvec2> project(const Piece& piece, glm::dvec3 axis) {
  const glm::dvec3 u = glm::normalize(std::abs(axis.y) < 0.8 ? glm::dvec3(axis.z, 0, -axis.x)
                                                             : glm::dvec3(0, -axis.z, axis.y));
  const glm::dvec3 v = glm::cross(axis, u);
  std::vector<glm::dvec2> result;
  for (const glm::dvec3 p : piece.points) result.emplace_back(glm::dot(p, u), glm::dot(p, v));
  return result;
}

bool stretchedAbove(double most, const Piece& piece, const std::vector<glm::dvec2>& at) {
  return !std::ranges::all_of(piece.triangles, [&](const std::array<std::uint32_t, 3>& t) {
    const Stretch stretch = stretchOf({piece.points[t[0]], piece.points[t[1]], piece.points[t[2]]},
                                      {at[t[0]], at[t[1]], at[t[2]]});
    return stretch.most <= most && stretch.least >= 1 / most;  // false of NaN, too
  });
}

using Two = std::array<std::uint32_t, 2>;  // triangles of a piece

// Turned into the smallest rectangle around all points. Or two triangles that overlap.
std::variant<CurvedChart, Two> place(const Piece& piece, std::vector<glm::dvec2> at) {
  const Rectangle around = smallestRectangle(at);
  for (glm::dvec2& p : at) {
    p -= around.corner;
    p = {glm::dot(p, around.along), glm::dot(p, around.across())};
  }
  std::vector<std::array<glm::dvec2, 3>> triangles;
  for (const auto& [a, b, c] : piece.triangles) triangles.push_back({at[a], at[b], at[c]});
  if (const auto found = findOverlap(triangles, kTouch * std::max(around.size.x, around.size.y)))
    return *found;
  CurvedChart chart;
  chart.size = vec2(around.size);
  for (const auto& [a, b, c] : triangles) {
    const auto inside = [&](glm::dvec2 p) { return glm::clamp(vec2(p), vec2(0.f), chart.size); };
    chart.corners.push_back({inside(a), inside(b), inside(c)});
  }
  return chart;
}

// The share of its rectangle that a chart covers.
double filled(const CurvedChart& chart) {
  double twice = 0;
  for (const auto& [a, b, c] : chart.corners) {
    const glm::dvec2 u(b - a), v(c - a);
    twice += u.x * v.y - u.y * v.x;
  }
  return twice / 2 / (static_cast<double>(chart.size.x) * chart.size.y);
}

// Steps over sides from one triangle to each.
std::vector<std::uint32_t> stepsFrom(const Cut& cut, std::uint32_t first) {
  std::vector<std::uint32_t> steps(cut.piece.triangles.size(), Surface::kNone);
  std::vector<std::uint32_t> queue{first};
  steps[first] = 0;
  for (std::size_t next = 0; next < queue.size(); ++next)
    for (std::uint32_t side = 3 * queue[next]; side < 3 * queue[next] + 3; ++side)
      if (const std::uint32_t other = cut.across[side];
          other != Surface::kNone && steps[other / 3] == Surface::kNone) {
        steps[other / 3] = steps[queue[next]] + 1;
        queue.push_back(other / 3);
      }
  return steps;
}

// The triangles that are farthest from each other, if not quite.
Two farthest(const Cut& cut) {
  const auto from = [&](std::uint32_t first) {
    const auto steps = stepsFrom(cut, first);
    return static_cast<std::uint32_t>(std::ranges::max_element(steps) - steps.begin());
  };
  const std::uint32_t one = from(0);
  return {one, from(one)};
}

// Makes the charts of one region.
class Charter {
 public:
  Charter(const Surface& surface, const CurvedSettings& settings)
      : surface_(surface), settings_(settings) {}

  std::vector<CurvedChart> run(Region whole) const {
    std::vector<CurvedChart> charts;
    std::vector<Region> waiting{std::move(whole)};
    while (!waiting.empty()) {
      const Region region = std::move(waiting.back());
      waiting.pop_back();
      const Cut cut = cutOut(surface_, region);
      std::variant<CurvedChart, Two> made = chartOf(region, cut);
      if (CurvedChart* chart = std::get_if<CurvedChart>(&made))
        charts.push_back(std::move(*chart));
      else
        std::ranges::move(split(region, cut, std::get<Two>(made)), std::back_inserter(waiting));
    }
    return charts;
  }

 private:
  // Unfolded, or else projected on the plane across the axis, which flips nothing and stretches
  // only as much as the cone is wide. If neither will do: two triangles to part.
  std::variant<CurvedChart, Two> chartOf(const Region& region, const Cut& cut) const {
    const Piece& piece = cut.piece;
    const std::uint32_t part = surface_.flatPart[region.triangles[0]];
    const bool flat = std::ranges::all_of(
        region.triangles, [&](std::uint32_t t) { return surface_.flatPart[t] == part; });
    const std::vector<glm::dvec2> projected = project(piece, region.axis);
    std::optional<Two> apart;
    for (const bool unfolding : {true, false}) {
      if (unfolding && region.cone <= kNearlyFlat) continue;
      std::vector<glm::dvec2> at = unfolding ? unfold(piece, projected) : projected;
      if (!flat) scaleToArea(piece, at);
      const bool single = piece.triangles.size() == 1;
      if (!single && stretchedAbove(settings_.mostStretch, piece, at)) continue;
      std::variant<CurvedChart, Two> placed = place(piece, std::move(at));
      if (CurvedChart* chart = std::get_if<CurvedChart>(&placed)) {
        if (!flat && filled(*chart) < settings_.leastFilled) return farthest(cut);
        chart->triangles = region.triangles;
        if (flat) chart->normal = vec3(region.axis);
        return placed;
      }
      apart = std::get<Two>(placed);
    }
    return apart ? *apart : farthest(cut);
  }

  // Each triangle goes to the nearer one of two.
  std::array<Region, 2> split(const Region& region, const Cut& cut, const Two& around) const {
    const auto toOne = stepsFrom(cut, around[0]), toOther = stepsFrom(cut, around[1]);
    std::array<Region, 2> parts;
    for (std::size_t i = 0; i < region.triangles.size(); ++i)
      parts[toOne[i] <= toOther[i] ? 0 : 1].triangles.push_back(region.triangles[i]);
    for (Region& part : parts) chooseAxis(part, region.axis);
    return parts;
  }

  void chooseAxis(Region& part, glm::dvec3 before) const {
    glm::dvec3 sum(0);
    for (const std::uint32_t t : part.triangles)
      sum += static_cast<double>(surface_.shapes[t].area) * glm::dvec3(surface_.shapes[t].normal);
    part.axis = glm::normalize(sum);
    part.cone = coneAround(part.axis, surface_, part.triangles);
    const double cone = coneAround(before, surface_, part.triangles);
    if (!(part.cone < cone)) part.axis = before, part.cone = cone;
  }

  const Surface& surface_;
  const CurvedSettings& settings_;
};

}  // namespace

CurvedCharts curvedCharts(std::span<const vec3> positions, std::span<const std::uint32_t> indices,
                          const CurvedSettings& settings) {
  const Surface surface = surfaceOf(positions, indices);
  std::vector<Region> regions = growRegions(surface, settings.growth);
  std::vector<std::vector<CurvedChart>> found(regions.size());
  parallelFor(regions.size(), kRegionsAtOnce, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      found[i] = Charter(surface, settings).run(std::move(regions[i]));
  });
  CurvedCharts result;
  for (std::vector<CurvedChart>& charts : found)
    std::ranges::move(charts, std::back_inserter(result.charts));
  std::ranges::sort(result.charts, {}, [](const CurvedChart& chart) { return chart.triangles[0]; });
  for (std::uint32_t t = 0; t < surface.triangles(); ++t)
    if (surface.shapes[t].area <= 0.f) result.degenerate.push_back(t);
  return result;
}

}  // namespace lucerna::bake
