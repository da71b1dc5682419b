// Ways to light a scene with shadows, each a chain of rows: what the suites soft-shadows and
// soft-shadows-quality compare. The table is in shadow_methods.cpp.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "app/bench/stage.hpp"

namespace lucerna::app::bench {

// Looks into shadow maps, the mask, widths and layers, in one pixel of the picture: as many as the
// method makes where none of its early ends spares any.
struct ShadowTaps {
  double perLight = 0;       // for each light that reaches the pixel
  double perPixel = 0;       // however many do
  double perFourLayers = 0;  // for each four layers of the frame, which one look reads

  double at(double lights, int layers) const;
};

struct ShadowMethod {
  std::string name;
  std::vector<Row> rows = {};  // between TileLights and TiledLighting
  Row lighting = {};           // TiledLighting
  ShadowTaps taps = {};

  bool shadows() const { return taps.perLight > 0; }
};

// "lighting alone", "hard", "pcf 11", "pcss 5+11" (search and kernel), "layered 11" (as the
// pipeline of that name), "layered 11, search, full", ... Asserts that there is one of that name.
const ShadowMethod& shadowMethod(std::string_view name);
std::vector<std::string> shadowMethodNames();

// What frames of all methods have in common.
struct ShadowFrame {
  int mapSize = 1024;               // texels of a lamp's map
  std::string conflicts = "tiles";  // ShadowLayers.conflicts
  std::vector<Row> afterLighting = {};
};
Chain chainOf(const ShadowMethod& method, const ShadowFrame& frame);

}  // namespace lucerna::app::bench
