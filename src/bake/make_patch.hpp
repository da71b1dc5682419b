// Patches (lightmap/patch.hpp) of the light of a group.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/file.hpp"
#include "lightmap/layout.hpp"
#include "lightmap/texel_tiles.hpp"

namespace lucerna::bake {

struct PatchLight {
  std::string group{};
  vec3 color{1.f};  // linear, times intensity: what is factored out, of whatever scale
  const lightmap::HalfTiles& irradiance;  // RGB; of the gap's filled texels, too
};

// At the group's own colour: a brighter one makes what is off brighter, too.
struct PatchTolerance {
  float light = 1.f / 255.f;   // irradiance by which a texel may be off
  float black = 1.f / 4096.f;  // irradiance up to which it is none at all; at most `light`
};

struct MadePatch {
  lightmap::Patch patch{};
  Bytes bytes{};                 // its file
  std::uint64_t otherBytes = 0;  // of the other form: of tiles alone, or with triangles everywhere
  float worst = 0.f;  // irradiance by which a texel is off: more than the tolerance only where
                      // light is so strong that 1/131070 of it is more
};

// May make the patches of several groups at once.
class PatchMaker {
 public:
  // used: of each map, row by row, the texels that the scene ever shows: on charts and in the gap
  // beside them. It outlives the maker.
  PatchMaker(const lightmap::Layout& layout, std::span<const std::vector<bool>> used);

  // Makes both forms and keeps the smaller, map by map. A value a texel is kept instead of three if
  // all light has the group's colour, to an eighth of the tolerance.
  MadePatch make(const PatchLight& light, const PatchTolerance& tolerance = {}) const;

 private:
  int side_, maps_;
  std::span<const std::vector<bool>> used_;
  std::vector<lightmap::PatchRoot> roots_;  // of all triangles of the layout, map by map
};

}  // namespace lucerna::bake
