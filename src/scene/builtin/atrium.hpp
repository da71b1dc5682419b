// builtin:atrium, a colonnaded hall of two storeys (options in builtin.hpp).
//
// Right-handed, metres: the nave runs along z from -22.5 to 22.5, 12 m wide between the column
// axes at x = +-6; aisles reach to x = +-10.5. The floor is y = 0, the gallery y = 7.5, the
// ceiling y = 13.5 with an open strip along the middle.
#pragma once

#include "scene/scene.hpp"

namespace lucerna::scene::builtin {

struct AtriumOptions {
  std::uint32_t lights = 16;
  LightKind kind = LightKind::Spot;
  float reach = 26.f;  // m, of the lights
  float moving = 0.f;  // share of the objects that is animated
  bool glass = false;  // translucent panes
  std::uint32_t seed = 1;
};

Scene makeAtrium(const AtriumOptions& options);

// The measures that the parts share, in metres.
namespace atrium {
inline constexpr int kBays = 10;
inline constexpr float kBay = 4.5f;  // between column axes
inline constexpr float kEnd = kBays * kBay / 2;
inline constexpr float kNave = 6.f;        // half-width to the column axes
inline constexpr float kWall = 10.5f;      // inner face of the outer walls
inline constexpr float kSpringing = 5.f;   // of the lower arches
inline constexpr float kLowerArch = 2.2f;  // from the springing to the slab
inline constexpr float kGallery = 7.5f;    // the upper floor
inline constexpr float kSlab = 0.3f;
inline constexpr float kUpperColumn = 3.6f;
inline constexpr float kUpperArch = 2.4f;
inline constexpr float kCeiling = kGallery + kUpperColumn + kUpperArch;
inline constexpr float kSkylight = 2.f;  // half-width of the open strip
}  // namespace atrium

// Indices of the hall's materials.
struct AtriumMaterials {
  std::uint32_t marble, stone, brick, floor, plaster, fabricRed, fabricBlue, bronze, glazeBlue,
      glazeGreen, leaves, lattice, iron, rose, terracotta;
  std::vector<std::uint32_t> bulbs;  // one for each colour of light
  std::vector<std::uint32_t> panes;
};
AtriumMaterials addAtriumMaterials(Scene& scene, const AtriumOptions& options);

// The colours of the lights (linear), in the order of AtriumMaterials::bulbs.
std::vector<vec3> atriumLightColors();

// Indices of the hall's shared meshes.
struct AtriumMeshes {
  std::uint32_t columnStone, shaft, lowerArch, upperArch, balustrade, coffer, naveFloor, aisleFloor,
      slab, lowerWall, lowerTrim, upperWall, upperTrim, lattice, pane, aisleCeiling, skylight,
      endWall, endTrim, rose, dais, plinth, robe, head, vase, pot, plant, banner, rod, lamp, bulb,
      chain;
};
AtriumMeshes addAtriumMeshes(Scene& scene);

}  // namespace lucerna::scene::builtin
