// Surfaces that emit light, as rectangular cells in a tree whose nodes stand for all cells below
// them where these are far enough away. What they give in all does not depend on how fine the
// texels are.
#pragma once

#include <cstdint>
#include <vector>

#include "bake/charts.hpp"
#include "bake/samples.hpp"
#include "core/result.hpp"

namespace lucerna::bake {

struct Emission {
  vec3 intensity{0.f};  // cd straight ahead: radiance times area, per colour
  vec3 positionW{0.f};  // the middle of the light
  vec3 normalW{0.f};    // unit; 0: the cells below face too many ways to be one light
};

struct EmitterNode {
  Aabb boxW;  // around the cells
  Emission emission;
  float size = 0.f;               // m, a bound of the distance between two points below
  vec3 axis{0.f};                 // all normals below are within the angle of this cosine
  float cosine = -1.f;            // around the axis
  float reach = 0.f;              // m: of the charts below, the farthest
  std::uint32_t right = 0;        // the left child follows the node; 0: a cell
  vec3 alongU{0.f}, alongV{0.f};  // of a cell: its sides, m in the world
  float texel = 0.f;              // m, the diagonal of one where the cell is
  bool isCell() const { return right == 0; }
};

// Cells of all charts of objects with an emissive material.
struct Emitters {
  std::vector<EmitterNode> nodes;  // [0] is the root; empty: nothing shines
  std::uint64_t cells = 0;
  Status status;  // an error if there would be too many cells; then there are none
};

struct CutCells {
  // Squares of one colour and plane as one cell, which grow no more with the density; else a cell
  // for each texel, the thesis' model.
  bool merged = false;
  std::uint64_t most = 8'000'000;  // more are an error; each takes 300 bytes
};

// faintest: irradiance; a chart reaches to where all of it together gives no more than this, and at
// most mostReach (m). 0: as far as mostReach.
Emitters findEmitters(const World& world, const std::vector<Chart>& charts, float faintest,
                      float mostReach, const CutCells& cut = {});

// Half of a cell by its longer sides, which: -1 or 1.
EmitterNode halfOf(const EmitterNode& cell, float which);

// How a point of an emitter shines, as a light: Lambert's law, or as the scene's hints say.
scene::PlacedLight lightOf(const Emission& emission, const scene::Scene& scene, float reach);

}  // namespace lucerna::bake
