// What of a chart emits light, cut into cells: along its texels, or into the largest squares of
// these that are of one colour and in one plane.
#pragma once

#include <atomic>
#include <cstdint>
#include <map>
#include <vector>

#include "bake/charts.hpp"
#include "bake/emission_texture.hpp"
#include "bake/emitters.hpp"

namespace lucerna::bake {

// What shines of a square of texels, as a rectangle with the same middle, the same extent (by its
// second moments) and the same light. It lies on top of what it stands for, so that a surface that
// bends does not stand in its own light.
struct Cell {
  Emission emission;
  ivec2 texel{0};                 // of its chart, the square's first
  vec3 alongU{0.f}, alongV{0.f};  // sides, m in the world
  float thickness = 0.f;          // m along the normal, of what it stands for
};

// textures: of those in emissive slots, by their place in the scene. Areas are exact; of pictures
// all pixels count. made: all cells so far, of both sides where a surface has two; no more are made
// once they exceed cut.most.
// Merged cells are as many as the facets and the pixels ask for, however fine the texels: squares
// become smaller where several planes meet, where an outline is aslant (down to a quarter of a
// facet), and where a picture is not even (down to a pixel).
std::vector<Cell> cellsOf(const World& world, const Chart& chart,
                          const std::map<std::uint32_t, EmissionTexture>& textures,
                          const CutCells& cut, std::atomic<std::uint64_t>& made);
// The same on the other side of the surface.
std::vector<Cell> backsOf(std::vector<Cell> cells);

}  // namespace lucerna::bake
