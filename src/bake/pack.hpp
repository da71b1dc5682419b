// Rectangles into square maps, by a skyline: Jylänki, "A Thousand Ways to Pack the Bin", 2010,
// section 2.3, with the lowest top first and the least waste below it second.
#pragma once

#include <span>
#include <vector>

#include "core/math/math.hpp"
#include "core/result.hpp"

namespace lucerna::bake {

struct PackSettings {
  int side = 2048;     // texels of a map
  int gap = 2;         // texels between rectangles, and none to a map's edge
  int mostMaps = 256;  // more are an error
};

struct Place {
  int map = 0;
  ivec2 corner{0};        // the least texel
  bool turned = false;    // by a right angle, counter-clockwise
  bool reversed = false;  // by half a turn; after turned
};

// Of a rectangle of this size where it lies: width and height change places if it is turned.
ivec2 placedSize(const Place& place, ivec2 size);

// Where a point of the rectangle, which goes from (0, 0) to size, lies in the map; in texels.
vec2 placedPoint(const Place& place, ivec2 size, vec2 point);

struct Packing {
  std::vector<Place> places;  // of each rectangle
  int maps = 0;
};

// sizes: width and height in texels, at least 1. The same input gives the same output. Errors: a
// rectangle that is larger than a map (ErrorKind::Input), or more maps than are allowed
// (ErrorKind::Usage); the message says about how many are needed.
Result<Packing> pack(std::span<const ivec2> sizes, const PackSettings& settings);

// Share of the texels of all maps but the last that rectangles cover, without their gaps; of the
// only map, if there is one alone. 0 of nothing.
double occupancy(const Packing& packing, std::span<const ivec2> sizes, int side);

// The errors of pack(), for who packs other shapes: each has to fit into a map by itself, and all
// into the maps that are allowed. texels: what the shapes take, with their gaps.
Status eachFits(std::span<const ivec2> sizes, const PackSettings& settings);
Error tooManyMaps(std::size_t charts, double texels, const PackSettings& settings);

}  // namespace lucerna::bake
