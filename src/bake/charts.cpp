#include "bake/charts.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "bake/curved_charts.hpp"
#include "bake/own_unwrap.hpp"
#include "bake/pair_charts.hpp"
#include "bake/triangle.hpp"
#include "core/check.hpp"
#include "core/parallel.hpp"
#include "core/progress.hpp"

namespace lucerna::bake {
namespace {

struct Box2 {
  vec2 min{std::numeric_limits<float>::infinity()};
  vec2 max{-std::numeric_limits<float>::infinity()};
  void grow(vec2 p) {
    min = glm::min(min, p);
    max = glm::max(max, p);
  }
};

Box2 boxOf(const Chart& chart) {
  Box2 box;
  for (const auto& triangle : chart.corners)
    for (const vec2 corner : triangle) box.grow(corner);
  return box;
}

// Whole texels; a rounding error beyond one is not worth another.
ivec2 texelsOf(vec2 size) {
  constexpr float kMost = 1e9f;  // more is too large for a map as well, and not for an integer
  return glm::max(ivec2(glm::ceil(glm::min(size, kMost) - 1e-3f)), ivec2(1));
}

// Moves the corners to the origin and sets the size.
void settle(Chart& chart) {
  const Box2 box = boxOf(chart);
  chart.size = texelsOf(box.max - box.min);
  const vec2 most(chart.size);
  for (auto& triangle : chart.corners)
    for (vec2& corner : triangle) corner = glm::clamp(corner - box.min, vec2(0.f), most);
}

// Two charts of the triangles whose centres lie below and above the middle of the longer side.
// False if they all lie on one side of it.
bool cut(const Chart& chart, Chart& low, Chart& high) {
  const int axis = chart.size.x >= chart.size.y ? 0 : 1;
  const float middle = 0.5f * static_cast<float>(chart.size[axis]);
  for (Chart* half : {&low, &high}) {
    half->object = chart.object;
    half->density = chart.density;
  }
  for (std::size_t i = 0; i < chart.triangles.size(); ++i) {
    const auto& c = chart.corners[i];
    Chart& half = (c[0][axis] + c[1][axis] + c[2][axis]) / 3.f < middle ? low : high;
    half.triangles.push_back(chart.triangles[i]);
    half.corners.push_back(c);
  }
  return !low.triangles.empty() && !high.triangles.empty();
}

void shrink(Chart& chart, int mostSide) {
  const Box2 box = boxOf(chart);
  const vec2 size = box.max - box.min;
  const float factor = static_cast<float>(mostSide) / std::max(size.x, size.y);
  for (auto& triangle : chart.corners)
    for (vec2& corner : triangle) corner *= factor;
  chart.density *= factor;
}

// Whether each triangle by itself has room in a map.
bool allFit(const Chart& chart, int mostSide) {
  return std::ranges::all_of(chart.corners, [&](const std::array<vec2, 3>& t) {
    const vec2 size = glm::max(glm::max(t[0], t[1]), t[2]) - glm::min(glm::min(t[0], t[1]), t[2]);
    return std::max(size.x, size.y) <= static_cast<float>(mostSide);
  });
}

// Adds the chart, or what it must be cut into to fit.
void add(Charts& result, Chart chart, int mostSide) {
  settle(chart);
  if (std::max(chart.size.x, chart.size.y) <= mostSide) {
    result.charts.push_back(std::move(chart));
    return;
  }
  Chart low, high;
  if (allFit(chart, mostSide) && cut(chart, low, high)) {
    add(result, std::move(low), mostSide);
    add(result, std::move(high), mostSide);
    return;
  }
  shrink(chart, mostSide);
  settle(chart);
  ++result.shrunk;
  result.charts.push_back(std::move(chart));
}

// One object's triangles with corners of its own, counter-clockwise seen from the front.
struct Part {
  std::vector<vec3> positions;
  std::vector<std::uint32_t> indices;
};

Part partOf(const World& world, const WorldObject& object) {
  const auto indices = world.indicesOf(object);
  const auto [least, most] = std::ranges::minmax(indices);
  Part part;
  part.positions.assign(world.positions.begin() + least, world.positions.begin() + most + 1);
  for (const std::uint32_t index : indices) part.indices.push_back(index - least);
  if (object.mirrored)
    for (std::size_t i = 0; i < part.indices.size(); i += 3)
      std::swap(part.indices[i + 1], part.indices[i + 2]);
  return part;
}

// Corners in the order of the part become those in the order of the mesh.
void addTriangle(Chart& chart, const WorldObject& object, std::uint32_t triangle,
                 std::array<vec2, 3> corners) {
  if (object.mirrored) std::swap(corners[1], corners[2]);
  for (vec2& corner : corners) corner *= chart.density;
  chart.triangles.push_back(triangle);
  chart.corners.push_back(corners);
}

// False if the object's mesh brings no coordinates that can be used.
bool addOwn(Charts& result, const World& world, std::uint32_t index,
            const ChartSettings& settings) {
  std::variant<Chart, std::string> own = ownUnwrap(world, index, settings);
  if (Chart* chart = std::get_if<Chart>(&own)) {
    chart->own = true;
    result.charts.push_back(std::move(*chart));
    ++result.own;
    return true;
  }
  if (const std::string& why = std::get<std::string>(own); !why.empty()) {
    const scene::Object& object = world.scene->objects[world.objects[index].object];
    result.unsound.push_back(fmt::format("'{}': TEXCOORD_1 is not used as {}",
                                         world.scene->nodes[object.node].name, why));
  }
  return false;
}

// Of triangles in no chart, those with corners that are numbers.
std::uint64_t withoutArea(const Part& part, std::span<const std::uint32_t> triangles) {
  return static_cast<std::uint64_t>(std::ranges::count_if(triangles, [&](std::size_t t) {
    const auto isSound = [&](std::size_t k) {
      return isFinite(part.positions[part.indices[3 * t + k]]);
    };
    return isSound(0) && isSound(1) && isSound(2);
  }));
}

void addCurved(Charts& result, const World& world, std::uint32_t index,
               const ChartSettings& settings) {
  const WorldObject& object = world.objects[index];
  const Part part = partOf(world, object);
  CurvedSettings curved;
  curved.growth.longest = static_cast<float>(settings.mostSide) / settings.density;
  const CurvedCharts found = curvedCharts(part.positions, part.indices, curved);
  result.degenerate += withoutArea(part, found.degenerate);
  for (const CurvedChart& each : found.charts) {
    Chart chart{.object = index, .density = settings.density};
    for (std::size_t i = 0; i < each.triangles.size(); ++i)
      addTriangle(chart, object, each.triangles[i], each.corners[i]);
    add(result, std::move(chart), settings.mostSide);
  }
}

std::array<vec2, 3> scaled(std::array<vec2, 3> corners, vec2 size) {
  for (vec2& corner : corners) corner *= size;
  return corners;
}

void addPairs(Charts& result, const World& world, std::uint32_t index,
              const ChartSettings& settings) {
  const WorldObject& object = world.objects[index];
  const Part part = partOf(world, object);
  const PairCharts found = pairCharts(part.positions, part.indices);
  result.degenerate += withoutArea(part, found.degenerate);
  for (const PairChart& pair : found.charts) {
    Chart chart{.object = index, .density = settings.density};
    addTriangle(chart, object, pair.first, scaled(pair.firstCorners, pair.size));
    if (pair.second != PairChart::kAlone) {
      addTriangle(chart, object, pair.second, scaled(pair.secondCorners, pair.size));
      // A step of a texel each way is just as far as a texel reaches across the diagonal, whatever
      // its slope: none is touched by both.
      for (vec2& corner : chart.corners.back()) corner += 1.f;
    }
    add(result, std::move(chart), settings.mostSide);
  }
}

}  // namespace

Charts makeCharts(const World& world, const ChartSettings& settings) {
  CHECK(settings.density > 0.f && settings.mostSide > 0);
  std::vector<Charts> parts(world.objects.size());
  Progress progress("cutting charts", world.triangleCount());
  parallelFor(parts.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end && !Progress::cancelled(); ++i) {
      progress.advance(world.objects[i].triangleCount);
      if (!world.objects[i].receives) continue;
      const auto index = static_cast<std::uint32_t>(i);
      if (settings.unwrap == Unwrap::Pairs)
        addPairs(parts[i], world, index, settings);
      else if (!addOwn(parts[i], world, index, settings))
        addCurved(parts[i], world, index, settings);
    }
  });
  Charts result;
  for (Charts& part : parts) {
    result.degenerate += part.degenerate;
    result.shrunk += part.shrunk;
    result.own += part.own;
    std::ranges::move(part.unsound, std::back_inserter(result.unsound));
    std::ranges::move(part.charts, std::back_inserter(result.charts));
  }
  return result;
}

}  // namespace lucerna::bake
