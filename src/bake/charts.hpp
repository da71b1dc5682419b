// A scene cut into charts: pieces that lie flat in a lightmap, in texels.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "bake/world.hpp"

namespace lucerna::bake {

enum class Unwrap {
  Charts,  // flat parts, and bent ones unfolded: bake/curved_charts.hpp
  Pairs,   // two right-angled triangles to a rectangle: bake/pair_charts.hpp
};

struct ChartSettings {
  Unwrap unwrap = Unwrap::Charts;
  float density = 10.f;  // texels a metre
  int gap = 2;           // texels between parts of meshes that bring their own coordinates
  // Texels. Larger charts are cut between triangles; one with a triangle that is larger has fewer
  // texels a metre.
  int mostSide = 2048;
};

// The texel (x, y) covers the square from (x, y) to (x + 1, y + 1).
struct Chart {
  std::uint32_t object = 0;                    // of World::objects
  std::vector<std::uint32_t> triangles{};      // of that object
  std::vector<std::array<vec2, 3>> corners{};  // of each, as its mesh orders them; texels
  ivec2 size{1};                               // texels, around all corners
  float density = 0.f;                         // texels a metre
  bool own = false;  // lies by its mesh's own coordinates: need not be one smooth surface
};

struct Charts {
  std::vector<Chart> charts;         // in the order of objects
  std::uint64_t degenerate = 0;      // triangles without an area; in no chart, as those not finite
  std::uint64_t own = 0;             // objects that bring a set of coordinates that serves
  std::vector<std::string> unsound;  // why those that others bring do not, a sentence each
  std::uint64_t shrunk = 0;          // charts that had to get fewer texels a metre to fit
};

// Depends on each object alone: an edit of one changes no chart of another.
Charts makeCharts(const World& world, const ChartSettings& settings);

}  // namespace lucerna::bake
