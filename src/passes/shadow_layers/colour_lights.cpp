#include "passes/shadow_layers/colour_lights.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>

namespace lucerna::passes {
namespace {

bool overlap(const LitSphere& a, const LitSphere& b) {
  return glm::distance(a.centerW, b.centerW) < a.radius + b.radius;
}

class Colouring {
 public:
  Colouring(const OverlapGraph& graph, int layers)
      : graph_(graph),
        layers_(static_cast<std::size_t>(layers)),
        layerOf_(graph.size(), kNoLayer),
        taken_(graph.size(), std::vector<bool>(layers_)),
        reserved_(layers_) {}

  // A layer that no other light may have.
  void alone(std::uint32_t light) {
    if (colour(light)) reserved_[static_cast<std::size_t>(layerOf_[light])] = true;
  }

  // The lowest that no neighbour has.
  bool colour(std::uint32_t light) {
    std::size_t layer = 0;
    while (layer < layers_ && (taken_[light][layer] || reserved_[layer])) ++layer;
    if (layer == layers_) return false;
    layerOf_[light] = static_cast<int>(layer);
    for (const std::uint32_t neighbour : graph_[light]) taken_[neighbour][layer] = true;
    return true;
  }

  // Of the light's neighbours.
  std::ptrdiff_t saturation(std::uint32_t light) const {
    return std::ranges::count(taken_[light], true);
  }

  std::vector<int> take() { return std::move(layerOf_); }

 private:
  const OverlapGraph& graph_;
  std::size_t layers_;
  std::vector<int> layerOf_;
  std::vector<std::vector<bool>> taken_;  // of each light, layers of its neighbours
  std::vector<bool> reserved_;
};

}  // namespace

LitSphere litSphere(const scene::PlacedLight& light) {
  if (std::isinf(light.reach)) return {.radius = light.reach};
  const float cosine = light.kind == scene::LightKind::Spot ? light.cosOuter : -1.f;
  if (cosine <= 0.f) return {light.positionW, light.reach};
  // Up to 45 degrees the sphere through the apex and the rim is the smallest, beyond that the one
  // on the rim.
  const float sine = std::sqrt(std::max(1.f - cosine * cosine, 0.f));
  if (cosine >= sine) {
    const float radius = 0.5f * light.reach / cosine;
    return {light.positionW + radius * light.directionW, radius};
  }
  return {light.positionW + light.reach * cosine * light.directionW, light.reach * sine};
}

OverlapGraph overlapsOf(std::span<const scene::PlacedLight> lights,
                        const std::vector<bool>& shadowed) {
  std::vector<LitSphere> spheres;
  for (const scene::PlacedLight& light : lights) spheres.push_back(litSphere(light));
  OverlapGraph graph(lights.size());
  for (std::uint32_t a = 0; a < lights.size(); ++a)
    for (std::uint32_t b = a + 1; b < lights.size(); ++b)
      if (shadowed[a] && shadowed[b] && overlap(spheres[a], spheres[b])) {
        graph[a].push_back(b);
        graph[b].push_back(a);
      }
  return graph;
}

OverlapGraph overlapsOf(std::span<const std::uint32_t> bits, const std::vector<bool>& shadowed) {
  const std::size_t words = (shadowed.size() + 31) / 32;
  OverlapGraph graph(shadowed.size());
  for (std::uint32_t a = 0; a < shadowed.size(); ++a)
    for (std::uint32_t b = 0; b < shadowed.size(); ++b)
      if (a != b && shadowed[a] && shadowed[b] && (bits[a * words + b / 32] >> (b % 32) & 1u))
        graph[a].push_back(b);
  return graph;
}

std::vector<int> colourLights(const OverlapGraph& graph, const std::vector<bool>& coloured,
                              std::span<const std::uint32_t> first, ColourOrder order, int layers) {
  Colouring colouring(graph, layers);
  std::vector<std::uint32_t> waiting;
  for (std::uint32_t i = 0; i < graph.size(); ++i)
    if (coloured[i] && std::ranges::find(first, i) == first.end()) waiting.push_back(i);
  for (const std::uint32_t light : first) colouring.alone(light);

  if (order == ColourOrder::Degree) {
    std::ranges::stable_sort(waiting, {}, [&](std::uint32_t i) { return graph[i].size(); });
    for (const std::uint32_t light : waiting) colouring.colour(light);
    return colouring.take();
  }
  while (!waiting.empty()) {
    const auto next = std::ranges::max_element(waiting, {}, [&](std::uint32_t i) {
      return std::tuple(colouring.saturation(i), graph[i].size(), -static_cast<std::int64_t>(i));
    });
    colouring.colour(*next);
    waiting.erase(next);
  }
  return colouring.take();
}

}  // namespace lucerna::passes
