// Lights whose lit volumes do not meet cannot shadow the same point: they may share a layer. Lights
// are vertices, overlaps edges, layers colours. No GL.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scene/light.hpp"

namespace lucerna::passes {

// Of each light, those that it overlaps; symmetric, in ascending order, without itself.
using OverlapGraph = std::vector<std::vector<std::uint32_t>>;

// A sphere around what the light reaches; infinite radius: everything.
struct LitSphere {
  vec3 centerW{0.f};
  float radius = 0.f;  // m
};
LitSphere litSphere(const scene::PlacedLight& light);

// By their spheres. shadowed: whether a light throws shadows; those that do not overlap nothing.
OverlapGraph overlapsOf(std::span<const scene::PlacedLight> lights,
                        const std::vector<bool>& shadowed);
// By bits: of each light, in as many words as hold a bit for each light, those that it overlaps.
OverlapGraph overlapsOf(std::span<const std::uint32_t> bits, const std::vector<bool>& shadowed);

enum class ColourOrder {
  Degree,      // system C's: first-fit in ascending order of degree
  Saturation,  // DSATUR: next the light whose neighbours have most layers (Brelaz, "New Methods to
               // Color the Vertices of a Graph", CACM 22(4), 1979)
};

// `layers` at most; first: lights that come before all others, each in a layer of its own. Returns
// a layer for each light; kNoLayer for one that no layer is left for, and for those not `coloured`.
inline constexpr int kNoLayer = -1;
std::vector<int> colourLights(const OverlapGraph& graph, const std::vector<bool>& coloured,
                              std::span<const std::uint32_t> first, ColourOrder order, int layers);

}  // namespace lucerna::passes
