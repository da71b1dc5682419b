// What of a chart emits light, cut along its texels.
#pragma once

#include <map>
#include <vector>

#include "bake/charts.hpp"
#include "bake/emission_texture.hpp"
#include "bake/emitters.hpp"

namespace lucerna::bake {

// What shines of one texel, as a rectangle with the same middle, the same extent (by its second
// moments) and the same light.
struct Cell {
  Emission emission;
  ivec2 texel{0};                 // of its chart
  vec3 alongU{0.f}, alongV{0.f};  // sides, m in the world
};

// textures: of those in emissive slots, by their place in the scene. Areas are exact; of pictures
// all pixels count.
std::vector<Cell> cellsOf(const World& world, const Chart& chart,
                          const std::map<std::uint32_t, EmissionTexture>& textures);
// The same on the other side of the surface.
std::vector<Cell> backsOf(std::vector<Cell> cells);

}  // namespace lucerna::bake
