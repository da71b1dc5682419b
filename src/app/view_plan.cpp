#include "app/view_plan.hpp"

#include <algorithm>
#include <cstring>

namespace lucerna::app {
namespace {

// Along one side of the picture.
struct Piece {
  unsigned origin, size, window;
};

struct Pieces {
  unsigned window;  // px
  std::vector<Piece> pieces;
};

unsigned upToGrid(unsigned pixels) {
  return (pixels + kTileGrid - 1) / kTileGrid * kTileGrid;
}

// All windows have one size and lie inside the picture: a pass that reads beyond the picture's edge
// meets the same edge.
Pieces divide(unsigned side, unsigned tile, unsigned guardBand) {
  const unsigned margin = side % kTileGrid;  // so that the last window, too, begins on the grid
  const unsigned wanted = tile + 2 * upToGrid(guardBand) + margin;
  if (tile == 0 || wanted >= side) return {.window = side, .pieces = {{0, side, 0}}};
  Pieces result{.window = wanted, .pieces = {}};
  for (unsigned begin = 0; begin < side; begin += tile) {
    const unsigned before = std::min(begin, upToGrid(guardBand));
    result.pieces.push_back({.origin = begin,
                             .size = std::min(tile, side - begin),
                             .window = std::min(begin - before, side - wanted)});
  }
  return result;
}

void copyRect(const Image& from, uvec2 at, Image& to, uvec2 where, uvec2 size) {
  const std::size_t pixel = bytesPer(from.type()) * static_cast<std::size_t>(from.channels());
  for (unsigned y = 0; y < size.y; ++y)
    std::memcpy(to.bytes().data() + (where.y + y) * to.rowBytes() + where.x * pixel,
                from.bytes().data() + (at.y + y) * from.rowBytes() + at.x * pixel, size.x * pixel);
}

// Red from the left eye, the rest from the right.
template <typename T>
Image anaglyph(const Image& left, Image right) {
  const auto from = left.as<T>();
  const auto to = right.as<T>();
  for (std::size_t i = 0; i < to.size(); i += static_cast<std::size_t>(right.channels()))
    to[i] = from[i];
  return right;
}

}  // namespace

ViewPlan planViews(uvec2 picture, int eyes, int tileSide, int guardBand) {
  CHECK(tileSide >= 0 && tileSide % kTileGrid == 0 && guardBand >= 0);
  const auto tile = static_cast<unsigned>(tileSide), band = static_cast<unsigned>(guardBand);
  const Pieces columns = divide(picture.x, tile, band), rows = divide(picture.y, tile, band);
  ViewPlan plan{.picture = picture, .window = {columns.window, rows.window}};
  for (int eye = 0; eye < eyes; ++eye)
    for (const Piece& row : rows.pieces)
      for (const Piece& column : columns.pieces)
        plan.places.push_back({.eye = eye,
                               .tile = {.origin = {column.origin, row.origin},
                                        .size = {column.size, row.size},
                                        .window = {column.window, row.window}}});
  return plan;
}

void placeTile(Image& picture, Image&& rendering, const ViewPlan& plan, const Tile& tile) {
  CHECK(uvec2(rendering.width(), rendering.height()) == plan.window);
  if (tile.size == plan.picture) {
    picture = std::move(rendering);
    return;
  }
  if (picture.empty())
    picture = Image(static_cast<int>(plan.picture.x), static_cast<int>(plan.picture.y),
                    rendering.channels(), rendering.type());
  copyRect(rendering, tile.origin - tile.window, picture, tile.origin, tile.size);
}

Image joinEyes(std::vector<Image>&& eyes, StereoLayout layout) {
  if (eyes.size() == 1) return std::move(eyes[0]);
  const Image &left = eyes[0], &right = eyes[1];
  if (layout == StereoLayout::Anaglyph) {
    CHECK(right.channels() == 3, "an anaglyph of {} channels", right.channels());
    if (right.type() == ComponentType::U8) return anaglyph<std::uint8_t>(left, std::move(eyes[1]));
    return anaglyph<float>(left, std::move(eyes[1]));
  }
  const bool beside = layout == StereoLayout::SideBySide;
  const uvec2 size(left.width(), left.height());
  const uvec2 second = beside ? uvec2(size.x, 0) : uvec2(0, size.y);
  Image both(static_cast<int>(size.x + second.x), static_cast<int>(size.y + second.y),
             left.channels(), left.type());
  copyRect(left, uvec2(0), both, uvec2(0), size);
  copyRect(right, uvec2(0), both, second, size);
  return both;
}

}  // namespace lucerna::app
