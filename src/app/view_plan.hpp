// The renderings that a picture is made of, and how they are put together: an eye or two, each in
// one piece or in tiles. No GL.
#pragma once

#include <vector>

#include "app/settings.hpp"
#include "image/image.hpp"

namespace lucerna::app {

// A part of a picture and the rendering that shows it: the tile with a guard band around it, as far
// as the picture reaches. Pixels from the upper left corner.
struct Tile {
  uvec2 origin{0}, size{0};  // of the part
  uvec2 window{0};           // where the rendering begins
};

struct ViewPlan {
  uvec2 picture{0};  // px of an eye's picture as it is rendered
  uvec2 window{0};   // px of each rendering
  struct Place {
    int eye = 0;  // 0: left or only one
    Tile tile;
  };
  std::vector<Place> places{};  // one a view, eye by eye

  int eyes() const { return places.back().eye + 1; }
};

// Windows and tiles begin at multiples of this, so that quads of pixels and textures of a half to a
// sixteenth of the size lie as in the whole picture.
inline constexpr int kTileGrid = 16;

// tileSide: px, a multiple of kTileGrid; 0: one piece. guardBand: px around a tile that count for
// its pixels.
ViewPlan planViews(uvec2 picture, int eyes, int tileSide, int guardBand);

// Copies the tile out of its rendering, which has the plan's window size, into its picture, which
// is made when it is empty.
void placeTile(Image& picture, Image&& rendering, const ViewPlan& plan, const Tile& tile);

// The eyes' pictures, of one size, as one; a single one stays as it is.
Image joinEyes(std::vector<Image>&& eyes, StereoLayout layout);

}  // namespace lucerna::app
