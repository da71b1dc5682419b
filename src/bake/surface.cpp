#include "bake/surface.hpp"

#include <algorithm>
#include <compare>
#include <tuple>

#include "bake/planar_charts.hpp"
#include "bake/weld.hpp"

namespace lucerna::bake {
namespace {

// Of an edge that very many share, a side is joined with one of this many next ones.
constexpr std::size_t kMostTried = 32;

struct Side {
  std::uint32_t low = 0, high = 0;
  bool rising = false;  // from low to high
  std::uint32_t apex = 0, number = 0;
  auto operator<=>(const Side&) const = default;
};

std::vector<Side> sidesOf(const Surface& surface, std::span<const std::uint32_t> indices,
                          std::span<const std::uint32_t> welded) {
  std::vector<Side> sides;
  sides.reserve(indices.size());
  for (std::uint32_t i = 0; i < 3 * surface.triangles(); ++i) {
    if (surface.shapes[i / 3].area <= 0.f) continue;
    const auto corner = [&](std::uint32_t k) { return welded[indices[i - i % 3 + (i + k) % 3]]; };
    const std::uint32_t from = corner(0), to = corner(1);
    sides.push_back({std::min(from, to), std::max(from, to), from < to, corner(2), i});
  }
  std::ranges::sort(sides);
  return sides;
}

// Of each triangle how many copies of it come before it.
std::vector<std::uint32_t> layersOf(std::size_t triangles, std::span<const Side> sides) {
  std::vector<std::uint32_t> layers(triangles, 0);
  for (std::size_t i = 1; i < sides.size(); ++i) {
    const Side &a = sides[i - 1], &b = sides[i];
    if (std::tie(a.low, a.high, a.rising, a.apex) == std::tie(b.low, b.high, b.rising, b.apex))
      layers[b.number / 3] = layers[a.number / 3] + 1;
  }
  return layers;
}

// Joins what it can of the sides of one edge.
void join(Surface& surface, std::span<const Side> sides, std::span<const std::uint32_t> layers) {
  struct Pair {
    bool apart;      // not of one flat part
    float minusDot;  // of the normals
    std::uint32_t a, b;
    auto operator<=>(const Pair&) const = default;
  };
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < sides.size(); ++i)
    for (std::size_t j = i + 1; j < std::min(sides.size(), i + 1 + kMostTried); ++j) {
      const std::uint32_t a = sides[i].number, b = sides[j].number;
      const bool apart = surface.flatPart[a / 3] != surface.flatPart[b / 3];
      if (sides[i].rising == sides[j].rising || (apart && layers[a / 3] != layers[b / 3])) continue;
      const float dot = glm::dot(surface.shapes[a / 3].normal, surface.shapes[b / 3].normal);
      pairs.push_back({apart, -dot, a, b});
    }
  std::ranges::sort(pairs, [](const Pair& a, const Pair& b) { return a < b; });
  for (const Pair& pair : pairs)
    if (surface.across[pair.a] == Surface::kNone && surface.across[pair.b] == Surface::kNone) {
      surface.across[pair.a] = pair.b;
      surface.across[pair.b] = pair.a;
    }
}

}  // namespace

Surface surfaceOf(std::span<const vec3> positions, std::span<const std::uint32_t> indices) {
  Surface surface;
  for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
    surface.corners.push_back(
        {positions[indices[i]], positions[indices[i + 1]], positions[indices[i + 2]]});
    surface.shapes.push_back(shapeOf(surface.corners.back()));
  }
  surface.across.assign(3 * surface.triangles(), Surface::kNone);
  surface.flatPart.assign(surface.triangles(), Surface::kNone);
  for (const PlanarChart& chart : planarCharts(positions, indices).charts) {
    for (const std::uint32_t triangle : chart.triangles)
      surface.flatPart[triangle] = static_cast<std::uint32_t>(surface.flatNormals.size());
    surface.flatNormals.push_back(chart.normal);
  }
  const std::vector<Side> sides = sidesOf(surface, indices, weld(positions));
  const std::vector<std::uint32_t> layers = layersOf(surface.triangles(), sides);
  for (std::size_t i = 0, end = 0; i < sides.size(); i = end) {
    while (end < sides.size() && sides[end].low == sides[i].low && sides[end].high == sides[i].high)
      ++end;
    join(surface, std::span(sides).subspan(i, end - i), layers);
  }
  return surface;
}

}  // namespace lucerna::bake
