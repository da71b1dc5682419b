#include "bake/emitters.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numeric>
#include <optional>

#include "bake/emission_texture.hpp"
#include "bake/emitting_cells.hpp"
#include "core/check.hpp"
#include "core/parallel.hpp"

namespace lucerna::bake {
namespace {

float brightness(vec3 color) {
  return color.x + color.y + color.z;
}

// Bits of x and y in turn.
std::uint64_t morton(ivec2 p) {
  std::uint64_t code = 0;
  for (unsigned bit = 0; bit < 31; ++bit) {
    code |= (static_cast<std::uint64_t>(p.x) >> bit & 1) << (2 * bit);
    code |= (static_cast<std::uint64_t>(p.y) >> bit & 1) << (2 * bit + 1);
  }
  return code;
}

class Builder {
 public:
  std::vector<EmitterNode> nodes;

  // A quadtree over the chart's texels, by halves.
  void addChart(std::vector<Cell>& cells, float reach) {
    reach_ = reach;
    std::ranges::sort(cells, {}, [](const Cell& c) { return morton(c.texel); });
    addRange(cells);
  }
  // A tree over trees that stand one behind the other, given by their first nodes.
  std::vector<EmitterNode> joined(
      std::vector<std::pair<std::uint32_t, std::uint32_t>> trees) const {
    std::vector<EmitterNode> result;
    result.reserve(nodes.size() + trees.size());
    join(result, trees);
    return result;
  }

 private:
  void addRange(std::span<const Cell> cells) {
    const std::size_t at = nodes.size();
    nodes.emplace_back();
    if (cells.size() == 1) {
      const Cell& cell = cells[0];
      EmitterNode& node = nodes[at];
      node.emission = cell.emission;
      node.axis = cell.emission.normalW;
      node.cosine = 1.f;
      node.reach = reach_;
      node.alongU = cell.alongU;
      node.alongV = cell.alongV;
      node.size =
          std::max(glm::length(cell.alongU + cell.alongV), glm::length(cell.alongU - cell.alongV));
      for (const vec2 side : {vec2(-1, -1), vec2(1, -1), vec2(-1, 1), vec2(1, 1)})
        node.boxW.grow(cell.emission.positionW +
                       0.5f * (side.x * cell.alongU + side.y * cell.alongV));
      return;
    }
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
    addRange(cells.first(half));
    nodes[at].right = static_cast<std::uint32_t>(nodes.size());
    addRange(cells.subspan(half));
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
    node.emission.normalW = oneChart && node.cosine >= kCosParallel ? node.axis : vec3(0.f);
  }

  float reach_ = 0.f;  // m, of the chart under way

  // trees: first node and count.
  void join(std::vector<EmitterNode>& result,
            std::span<std::pair<std::uint32_t, std::uint32_t>> trees) const {
    if (trees.empty()) return;
    if (trees.size() == 1) {
      const auto offset = static_cast<std::uint32_t>(result.size()) - trees[0].first;
      for (std::uint32_t i = 0; i < trees[0].second; ++i) {
        EmitterNode node = nodes[trees[0].first + i];
        if (!node.isCell()) node.right += offset;
        result.push_back(node);
      }
      return;
    }
    Aabb centres;
    for (const auto& tree : trees) centres.grow(nodes[tree.first].boxW.center());
    const vec3 extent = centres.extent();
    const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0
                     : extent.y >= extent.z                       ? 1
                                                                  : 2;
    std::ranges::stable_sort(
        trees, {}, [&](const auto& tree) { return nodes[tree.first].boxW.center()[axis]; });
    const std::size_t at = result.size();
    result.emplace_back();
    join(result, trees.first(trees.size() / 2));
    result[at].right = static_cast<std::uint32_t>(result.size());
    join(result, trees.subspan(trees.size() / 2));
    combine(result, at, false);
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

}  // namespace

Emitters findEmitters(const World& world, const std::vector<Chart>& charts, float faintest,
                      float mostReach) {
  const scene::Scene& scene = *world.scene;
  Emitters result;
  if (!scene.bake.areaLights) return result;
  std::map<std::uint32_t, EmissionTexture> textures;
  std::vector<std::uint32_t> shining;  // charts
  for (std::uint32_t i = 0; i < charts.size(); ++i) {
    const WorldObject& object = world.objects[charts[i].object];
    const scene::Material& material = scene.materials[scene.objects[object.object].material];
    if (material.emissive == vec3(0.f)) continue;
    shining.push_back(i);
    const scene::TextureSlot& slot = material.emissiveTexture;
    if (slot.used() && slot.coordinates == scene::Coordinates::Mesh)
      textures.try_emplace(slot.texture, scene.textures[slot.texture]);
  }
  std::vector<std::vector<Cell>> cells(shining.size());
  parallelFor(shining.size(), 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      cells[i] = cellsOf(world, charts[shining[i]], textures);
  });
  Builder builder;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> trees;
  const auto addTree = [&](std::vector<Cell> list) {
    if (list.empty()) return;
    result.cells += list.size();
    const auto first = static_cast<std::uint32_t>(builder.nodes.size());
    builder.addChart(list, std::min(reachOf(list, scene, faintest), mostReach));
    trees.emplace_back(first, static_cast<std::uint32_t>(builder.nodes.size()) - first);
  };
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const WorldObject& object = world.objects[charts[shining[i]].object];
    if (scene.materials[scene.objects[object.object].material].doubleSided)
      addTree(backsOf(cells[i]));
    addTree(std::move(cells[i]));
  }
  result.nodes = builder.joined(std::move(trees));
  return result;
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
