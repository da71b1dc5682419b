// builtin:nightcity, a city at night (options in builtin.hpp).
//
// Metres, y up, streets along x and z on lines that are multiples of kPitch; the boulevard is the
// line x = 0. North is -z. From the crossing at the origin the boulevard passes below the highway
// (over the street z = -kPitch) and enters a tunnel after the crossing at z = -2 kPitch.
//
// The amount of emission: the share of lit windows is derived, not fixed. A baker with eight maps
// of 2048^2 texels, three quarters of them used, spreads that many texels over all surfaces; the
// share is chosen such that kEmitterPoints of these texels lie on lit parts of emission textures.
#pragma once

#include <array>
#include <optional>

#include "core/random.hpp"
#include "scene/builtin/mesh_builder.hpp"
#include "scene/scene.hpp"

namespace lucerna::scene::builtin {

struct NightCityOptions {
  std::uint32_t blocks = 8;
  float rotate = 0;         // degrees
  float jitter = 0;         // 0 to 1
  std::optional<vec2> sun;  // elevation, azimuth in degrees
  bool lamps = true;        // on
  std::uint32_t seed = 1;
};

Scene makeNightCity(const NightCityOptions& options);

namespace city {

inline constexpr float kPitch = 247.5f;  // between street axes: 8 blocks and a street make 2 km
inline constexpr float kRoad = 20.f;     // kerb to kerb
inline constexpr float kBlockHalf = (kPitch - kRoad) / 2;
inline constexpr float kSidewalk = 5.f;
inline constexpr float kYard = 2 * (kBlockHalf - kSidewalk);  // side of a block within pavements
inline constexpr float kKerb = 0.15f;                         // height
inline constexpr float kLampSpacing = 28.f;
inline constexpr int kLampSlots = 8;  // along one side of a block
inline constexpr std::uint32_t kLamps = 106, kSwitchable = 13;

inline constexpr float kHighwayZ = -kPitch, kHighwayTop = 9.f, kHighwayHalf = 8.5f;
inline constexpr float kSpan = kPitch / 6;  // between the highway's pillars
inline constexpr float kTunnelFrom = -2 * kPitch - 16, kTunnelTo = -3 * kPitch + 16;
inline constexpr float kTunnelHalf = 11.5f, kTunnelSpring = 4.2f, kTunnelRise = 3.6f;

inline constexpr float kEmitterPoints = 150'000;
inline constexpr float kLightmapTexels = 8 * 2048.f * 2048.f * 0.75f;

// The window grid of a facade texture.
inline constexpr int kColumns = 8, kRows = 16;
enum Style { kBrick, kClassic, kPlaster, kOffice, kConcrete, kGlass, kStyles };

struct Facade {
  float cellWidth, cellHeight;  // m, one window with its share of wall
  vec2 low, high;               // the window in its cell, shares from the left and the top
  float weight;                 // how likely its windows are lit, relative to the others
};
const Facade& facade(Style style);

struct Materials {
  std::array<std::uint32_t, kStyles> facades;
  std::uint32_t shops, roof, tiles, sidewalk, yard, road, zebra, crossing, concrete, deck,
      tunnelWall, tunnelCeiling, grass, tree, metal, dark, neon, tail, beam;
  std::array<std::uint32_t, 4> paints;
  std::array<std::uint32_t, 3> glows;  // of lamp heads, by Tint
};
enum Tint { kWarm, kSodium, kCold };
vec3 tintColor(Tint tint);

Materials addMaterials(Scene& scene);
// Paints all pictures but the emission of facades.
void addTextures(Scene& scene, const Materials& materials, std::uint32_t seed);
// Lights so many windows that the scene has kEmitterPoints; needs all other objects to be there.
void lightWindows(Scene& scene, const Materials& materials, std::uint32_t seed);
void addSky(Scene& scene, bool day, std::uint32_t seed);

// Which street lines there are: first to last, inclusive, in both directions.
struct Extent {
  int first, last;
  float low() const { return kPitch * static_cast<float>(first) - kRoad / 2; }
  float high() const { return kPitch * static_cast<float>(last) + kRoad / 2; }
};

struct City {
  Scene& scene;
  const NightCityOptions& options;
  Materials materials;
  Extent extent;
  std::uint32_t root;
};

void addBlocks(City& city);
void addRoads(City& city);
void addHighway(City& city);
void addTunnel(City& city);
void addLamps(City& city);
void addCars(City& city);
void addSigns(City& city);

}  // namespace city
}  // namespace lucerna::scene::builtin
