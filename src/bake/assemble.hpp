// Finished units put into maps.
#pragma once

#include <vector>

#include "bake/plan.hpp"
#include "bake/unit_light.hpp"
#include "image/image.hpp"
#include "lightmap/texel_tiles.hpp"

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

// Of Plan::groups.
struct GroupRange {
  std::uint32_t first = 0, last = 0xffffffffu;  // one after it
  bool has(std::uint32_t group) const { return first <= group && group < last; }
};

// Groups take memory while they are here, so whoever has many puts in some at a time: as many as
// take mostGroupBytes() together, at kLitBytes a texel (six, and those of tiles that are not full)
// and kGroupBytes each.
inline constexpr std::uint64_t kLitBytes = 8, kGroupBytes = 32 << 10;
std::uint64_t mostGroupBytes(const Plan& plan);

struct BakedLight {
  MapTexels texels;
  std::vector<Image> maps;                  // Half RGB, of Plan::groups[0]
  std::vector<lightmap::HalfTiles> groups;  // as Plan::groups, RGB where there is any; [0] is empty
};

BakedLight emptyLight(const Plan& plan);
// The light of these groups, and what the unit's texels are.
void putInMaps(BakedLight& baked, const Plan& plan, const Unit& unit, const UnitLight& light,
               const GroupRange& groups = {});

// Gives texels beside those that the scene touches the light of these, for bilinear filtering; in
// the maps and in the groups that are there. Texels inside of solids get the darkest: what is on
// the other side of a wall is not to shine through.
void dilate(BakedLight& baked);

}  // namespace lucerna::bake
