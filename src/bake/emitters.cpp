#include "bake/emitters.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <map>
#include <span>

#include "bake/brightness.hpp"
#include "bake/emission_texture.hpp"
#include "bake/emitting_cells.hpp"
#include "core/parallel.hpp"

namespace lucerna::bake {
namespace {

// Bits of x and y in turn.
std::uint64_t morton(ivec2 p) {
  std::uint64_t code = 0;
  for (unsigned bit = 0; bit < 31; ++bit) {
    code |= (static_cast<std::uint64_t>(p.x) >> bit & 1) << (2 * bit);
    code |= (static_cast<std::uint64_t>(p.y) >> bit & 1) << (2 * bit + 1);
  }
  return code;
}

// A cell's box and size, by its middle and sides.
void fitBox(EmitterNode& cell) {
  const vec3 u = cell.alongU, v = cell.alongV;
  cell.size = std::max(glm::length(u + v), glm::length(u - v));
  cell.boxW = {};
  for (const vec2 side : {vec2(-1, -1), vec2(1, -1), vec2(-1, 1), vec2(1, 1)})
    cell.boxW.grow(cell.emission.positionW + 0.5f * (side.x * u + side.y * v));
}

// One side of what shines of a chart.
struct Emitting {
  std::vector<Cell> cells;
  float reach = 0.f, texel = 0.f;  // m, as EmitterNode
  Aabb boxW{};                     // around the cells
};

EmitterNode nodeOf(const Cell& cell, const Emitting& chart) {
  EmitterNode node;
  node.emission = cell.emission;
  node.axis = cell.emission.normalW;
  node.cosine = 1.f;
  node.reach = chart.reach;
  node.texel = chart.texel;
  node.alongU = cell.alongU;
  node.alongV = cell.alongV;
  fitBox(node);
  return node;
}

class Builder {
 public:
  std::vector<EmitterNode> nodes;

  // A tree over the charts' trees; takes their cells.
  void add(std::span<Emitting> charts) {
    if (charts.size() == 1) {
      addChart(charts[0]);
      charts[0].cells = {};
      return;
    }
    Aabb centres;
    for (const Emitting& chart : charts) centres.grow(chart.boxW.center());
    const vec3 extent = centres.extent();
    const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0
                     : extent.y >= extent.z                       ? 1
                                                                  : 2;
    std::ranges::stable_sort(charts, {},
                             [&](const Emitting& chart) { return chart.boxW.center()[axis]; });
    const std::size_t at = nodes.size();
    nodes.emplace_back();
    add(charts.first(charts.size() / 2));
    nodes[at].right = static_cast<std::uint32_t>(nodes.size());
    add(charts.subspan(charts.size() / 2));
    combine(nodes, at, false);
  }

 private:
  // A quadtree over the chart's squares, by halves.
  void addChart(Emitting& chart) {
    std::ranges::stable_sort(chart.cells, {}, [](const Cell& c) { return morton(c.texel); });
    addRange(chart, chart.cells);
  }
  void addRange(const Emitting& chart, std::span<const Cell> cells) {
    if (cells.size() == 1) {
      nodes.push_back(nodeOf(cells[0], chart));
      return;
    }
    const std::size_t at = nodes.size();
    nodes.emplace_back();
    // Where the highest bit changes, which is where a square is halved.
    const std::uint64_t first = morton(cells.front().texel), last = morton(cells.back().texel);
    std::size_t half = cells.size() / 2;
    if (first != last) {
      std::uint64_t bit = 1ull << 63;
      while (((first ^ last) & bit) == 0) bit >>= 1;
      half = static_cast<std::size_t>(
          std::ranges::partition_point(
              cells, [&](const Cell& c) { return (morton(c.texel) & bit) == 0; }) -
          cells.begin());
    }
    addRange(chart, cells.first(half));
    nodes[at].right = static_cast<std::uint32_t>(nodes.size());
    addRange(chart, cells.subspan(half));
    combine(nodes, at, true);
  }

  // A node from its two children.
  static void combine(std::vector<EmitterNode>& list, std::size_t at, bool oneChart) {
    constexpr float kCosParallel = 0.999f;  // farther apart, two halves are not one light
    const EmitterNode a = list[at + 1], b = list[list[at].right];
    EmitterNode& node = list[at];
    node.boxW = a.boxW;
    node.boxW.grow(b.boxW);
    node.reach = std::max(a.reach, b.reach);
    const float wa = brightness(a.emission.intensity), wb = brightness(b.emission.intensity);
    node.emission.intensity = a.emission.intensity + b.emission.intensity;
    node.emission.positionW = (a.emission.positionW * wa + b.emission.positionW * wb) / (wa + wb);
    node.size = node.boxW.diagonal();
    const vec3 axis = a.axis * wa + b.axis * wb;
    const float length = glm::length(axis);
    node.axis = length > 0.f ? axis / length : vec3(0.f);
    node.cosine = -1.f;
    if (length > 0.f && a.cosine > 0.f && b.cosine > 0.f) {
      const auto angleTo = [&](const EmitterNode& child) {
        return std::acos(std::clamp(glm::dot(node.axis, child.axis), -1.f, 1.f)) +
               std::acos(std::min(child.cosine, 1.f));
      };
      const float angle = std::max(angleTo(a), angleTo(b));
      // Some more, for what the arc cosines round.
      node.cosine = angle < 0.5f * kPi ? std::cos(angle) - 1e-5f : -1.f;
    }
    if (oneChart && node.cosine >= kCosParallel) raise(node, a, b);
  }

  // Makes a node that is nearly flat one light, which lies on top of its children, as Cell.
  static void raise(EmitterNode& node, const EmitterNode& a, const EmitterNode& b) {
    node.emission.normalW = node.axis;
    float above = 0.f;
    for (const EmitterNode* child : {&a, &b}) {
      const float tilt = glm::length(glm::cross(node.axis, child->axis));
      above = std::max(
          above, tilt * child->size +
                     glm::dot(node.axis, child->emission.positionW - node.emission.positionW));
    }
    node.emission.positionW += above * node.axis;
  }
};

// Where all cells together, at one point and seen straight ahead, give the faintest irradiance.
float reachOf(std::span<const Cell> cells, const scene::Scene& scene, float faintest) {
  if (faintest <= 0.f) return std::numeric_limits<float>::infinity();
  Emission all;
  for (const Cell& cell : cells) all.intensity += cell.emission.intensity;
  const vec3 i = lightOf(all, scene, 1.f).intensity;
  return std::sqrt(std::max({i.x, i.y, i.z}) / faintest);
}

const scene::Material& materialOf(const World& world, const Chart& chart) {
  const scene::Scene& scene = *world.scene;
  return scene.materials[scene.objects[world.objects[chart.object].object].material];
}

// The density at which they would fit is that where there are no more texels than cells.
Error tooMany(const World& world, const std::vector<Chart>& charts,
              std::span<const std::uint32_t> shining, std::uint64_t most) {
  double texels = 0.;
  float density = 0.f;
  for (const std::uint32_t i : shining) {
    double twice = 0.;
    for (const auto& c : charts[i].corners) {
      const vec2 b = c[1] - c[0], d = c[2] - c[0];
      twice += std::abs(double{b.x} * double{d.y} - double{b.y} * double{d.x});
    }
    texels += (materialOf(world, charts[i]).doubleSided ? 1. : 0.5) * twice;
    density = std::max(density, charts[i].density);
  }
  constexpr double kBorders = 0.7;  // texels that are touched in part count too
  const double fits =
      kBorders * static_cast<double>(density) *
      std::sqrt(static_cast<double>(most) / std::max(texels, static_cast<double>(most)));
  return error(
      ErrorKind::Usage,
      "surfaces that shine would be cut into more than {} cells, of 300 bytes each, at {:g} "
      "texels a metre; bake at about {:.2g} (--density), or without their light: \"bake\": "
      "{{\"areaLights\": false}} in the scene",
      most, density, fits);
}

}  // namespace

Emitters findEmitters(const World& world, const std::vector<Chart>& charts, float faintest,
                      float mostReach, const CutCells& cut) {
  const scene::Scene& scene = *world.scene;
  if (!scene.bake.areaLights) return {};
  std::map<std::uint32_t, EmissionTexture> textures;
  std::vector<std::uint32_t> shining;  // charts
  for (std::uint32_t i = 0; i < charts.size(); ++i) {
    const scene::Material& material = materialOf(world, charts[i]);
    if (material.emissive == vec3(0.f)) continue;
    shining.push_back(i);
    const scene::TextureSlot& slot = material.emissiveTexture;
    if (slot.used() && slot.coordinates == scene::Coordinates::Mesh)
      textures.try_emplace(slot.texture, scene.textures[slot.texture]);
  }
  std::vector<std::vector<Cell>> cells(shining.size());
  std::atomic<std::uint64_t> made = 0;
  parallelFor(shining.size(), 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      cells[i] = cellsOf(world, charts[shining[i]], textures, cut, made);
  });
  Emitters result;
  if (made > cut.most) {
    result.status = tooMany(world, charts, shining, cut.most);
    return result;
  }
  std::vector<Emitting> sides;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (cells[i].empty()) continue;
    const Chart& chart = charts[shining[i]];
    Emitting side{.cells = std::move(cells[i]),
                  .reach = 0.f,
                  .texel = std::sqrt(2.f) / std::max(chart.density, 1e-6f)};
    side.reach = std::min(reachOf(side.cells, scene, faintest), mostReach);
    for (const Cell& cell : side.cells) side.boxW.grow(nodeOf(cell, side).boxW);
    result.cells += side.cells.size();
    sides.push_back(std::move(side));
    if (!materialOf(world, chart).doubleSided) continue;
    Emitting back = sides.back();
    back.cells = backsOf(std::move(back.cells));
    result.cells += back.cells.size();
    sides.push_back(std::move(back));
  }
  if (sides.empty()) return result;
  Builder builder;
  builder.nodes.reserve(2 * result.cells - 1);
  builder.add(sides);
  result.nodes = std::move(builder.nodes);
  return result;
}

EmitterNode halfOf(const EmitterNode& cell, float which) {
  EmitterNode half = cell;
  vec3& longer = glm::length(cell.alongU) >= glm::length(cell.alongV) ? half.alongU : half.alongV;
  half.emission.positionW += 0.25f * which * longer;
  half.emission.intensity *= 0.5f;
  longer *= 0.5f;
  fitBox(half);
  return half;
}

scene::PlacedLight lightOf(const Emission& emission, const scene::Scene& scene, float reach) {
  scene::PlacedLight light;
  light.kind = scene::LightKind::Spot;
  light.positionW = emission.positionW;
  light.directionW = emission.normalW;
  light.intensity = emission.intensity;
  light.attenuation = {0.f, 0.f, 1.f};
  light.reach = reach;
  light.cosOuter = 0.f;
  light.cosInner = 1e-3f;
  light.exponent = 1.f;
  if (const auto& rule = scene.bake.area) {
    light.intensity *= kPi * rule->intensity / rule->attenuation;
    light.cosOuter = light.cosInner = std::cos(rule->cut);
    light.exponent = 0.f;
  }
  return light;
}

}  // namespace lucerna::bake
