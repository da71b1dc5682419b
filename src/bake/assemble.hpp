// Finished units put into maps.
#pragma once

#include <vector>

#include "bake/plan.hpp"
#include "bake/unit_light.hpp"
#include "image/image.hpp"

namespace lucerna::bake {

// A texel of a map that lies on the scene, or beside one that does.
struct MapTexels {
  int side = 0;
  std::vector<std::vector<bool>> touched;  // of each map, row by row
  std::vector<std::vector<bool>> hidden;   // of charts, inside of solids: not touched

  bool has(int map, ivec2 p) const {
    return p.x >= 0 && p.y >= 0 && p.x < side && p.y < side &&
           touched[static_cast<std::size_t>(map)][static_cast<std::size_t>(p.y) * side + p.x];
  }
  bool isHidden(int map, ivec2 p) const {
    return hidden[static_cast<std::size_t>(map)][static_cast<std::size_t>(p.y) * side + p.x];
  }
  // Not on the scene, but next to a texel that is: one that is filled for bilinear filtering.
  bool isBeside(int map, ivec2 p) const;
};

// One group's light where there is any: irradiance.
struct LitTexel {
  std::uint16_t map = 0, x = 0, y = 0;
  std::array<std::uint16_t, 3> rgb{};  // half floats
};

struct BakedLight {
  MapTexels texels;
  std::vector<Image> maps;                    // Half RGB, of Plan::groups[0]
  std::vector<std::vector<LitTexel>> groups;  // as Plan::groups; [0] is empty
};

BakedLight emptyLight(const Plan& plan);
void putInMaps(BakedLight& baked, const Plan& plan, const Unit& unit, const UnitLight& light);

// Gives texels beside those that the scene touches the light of these, for bilinear filtering; in
// the maps and in the groups. Texels inside of solids get the darkest: what is on the other side of
// a wall is not to shine through. Sorts the groups by map, row and column.
void dilate(BakedLight& baked);

}  // namespace lucerna::bake
