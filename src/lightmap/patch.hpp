// A patch: the light of one group of lights on the maps, added while the group is on (system B,
// sections 4.1 and 5.1.4). A texel's irradiance is its value, channel by channel, times a colour
// that is free at run time; times Patch::color it is what the scene's own lights give.
//
// Its light is said in two ways, and what the second says of a texel stands instead of the first:
//   triangles of the maps, split in four wherever interpolation between three corners is not the
//   light (the thesis' patches), and sparse tiles of 8 x 8 texels.
// A patch without triangles has the form "tiles"; one with them has in tiles what triangles say
// badly: borders of charts, edges of shadows. lightmap/unpack.hpp makes tiles of both.
//
// Texels beside a chart that filters reach (the gap, filled from its neighbours) are texels like
// any other.
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "core/file.hpp"
#include "core/math/math.hpp"

namespace lucerna::lightmap {

inline constexpr int kTileSide = 8;  // texels
inline constexpr int kTileTexels = kTileSide * kTileSide;

struct TilePlace {
  std::uint16_t map = 0, x = 0, y = 0;  // in tiles

  std::strong_ordering operator<=>(const TilePlace& other) const {
    return std::tie(map, y, x) <=> std::tie(other.map, other.y, other.x);
  }
  bool operator==(const TilePlace& other) const = default;
};

// A value is the scale times 0 to 65535, so it is off by at most 1/131070 of the tile's largest: at
// that value a half float is off by 32 to 64 times as much.
struct LightTile {
  TilePlace place{};
  float scale = 0.f;
  std::uint64_t mask = 0;  // bit row * 8 + column: it says something of this texel
};

struct TileLight {
  std::vector<LightTile> tiles{};  // by place, each place once
  // Of each tile, one channel after the other, all of its texels; 0 outside of its mask.
  std::vector<std::uint16_t> values{};
};

enum class PatchNode : std::uint8_t { Nothing, Leaf, Split };

// A triangle of the layout, in 1/kPatchUnit texels.
struct PatchRoot {
  std::uint16_t map = 0;
  std::uint8_t borders = 0;  // bit i: its chart ends at the edge opposite to corner i
  float scale = 0.f;         // of the values of its leaves
  std::array<ivec2, 3> corners{};
};

inline constexpr int kPatchUnit = 16;
inline constexpr int kMostSplits = 8;

struct TriangleLight {
  std::vector<PatchRoot> roots{};
  std::vector<PatchNode> nodes{};  // of each root in turn; after a Split come its four parts
  // Of each Leaf in turn, one channel after the other: at its three corners.
  std::vector<std::uint16_t> values{};
};

struct Patch {
  std::string group{};
  vec3 color{1.f};            // linear, times intensity: of the group as the scene has it
  int side = 0;               // texels of each map
  int maps = 0;               // of the layout
  std::uint8_t channels = 1;  // 1: one value for red, green and blue; 3: one for each
  float least = 0.f;          // triangles light nothing where they give at most this
  TriangleLight triangles{};
  TileLight tiles{};

  std::string_view form() const { return triangles.roots.empty() ? "tiles" : "triangles"; }
};

Bytes toBytes(const Patch& patch);
// Errors (ErrorKind::Input) name the file. What comes back lies within its maps and refers to
// nothing outside of itself.
Result<Patch> patchFrom(std::span<const std::byte> bytes, const std::string& name);

}  // namespace lucerna::lightmap
