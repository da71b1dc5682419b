#include "bake/pack_masks.hpp"

#include <algorithm>
#include <compare>
#include <cstdint>
#include <numeric>
#include <optional>
#include <utility>

#include "bake/cancelled.hpp"
#include "bake/free_squares.hpp"
#include "bake/mask_squares.hpp"
#include "core/check.hpp"

namespace lucerna::bake {
namespace {

std::int64_t areaOf(ivec2 size) {
  return std::int64_t{size.x} * size.y;
}

// Larger rectangles first; the same masks follow each other.
std::vector<std::uint32_t> packingOrder(std::span<const TexelMask> masks) {
  std::vector<std::uint32_t> order(masks.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::sort(order, [&](std::uint32_t a, std::uint32_t b) {
    const TexelMask &p = masks[a], &q = masks[b];
    if (const auto areas = areaOf(q.size()) <=> areaOf(p.size()); areas != 0) return areas < 0;
    if (const auto shapes = p <=> q; shapes != 0) return shapes < 0;
    return a < b;
  });
  return order;
}

// A shape in one of its orientations.
struct Turned {
  Place turn;  // no place yet
  ivec2 size{0};
  std::vector<Square> squares{};
  std::vector<int> fromRows{};  // of each map: this shape fits into no lower row
};
using Shape = std::vector<Turned>;

Square turnedSquare(Square square, ivec2 size) {
  return {{size.y - square.corner.y - square.side(), square.corner.x}, square.level};
}

// Rectangles in two orientations, others in four; by a right angle from one to the next.
Shape shapeOf(const TexelMask& mask) {
  CHECK(mask.count() > 0, "a mask without texels");
  const ivec2 size = mask.size();
  const bool isRectangle = mask.count() == areaOf(size);
  const int turns = !isRectangle ? 4 : size.x != size.y ? 2 : 1;
  Shape shape{{.turn = {}, .size = size, .squares = squaresOf(mask)}};
  for (int turn = 1; turn < turns; ++turn) {
    const Turned& last = shape.back();
    Turned next{.turn = {.turned = turn % 2 != 0, .reversed = turn >= 2},
                .size = {last.size.y, last.size.x}};
    for (const Square& square : last.squares)
      next.squares.push_back(turnedSquare(square, last.size));
    shape.push_back(std::move(next));
  }
  return shape;
}

class Maps {
 public:
  explicit Maps(const PackSettings& settings) : settings_(settings) {}

  int count() const { return static_cast<int>(maps_.size()); }
  void add() { maps_.emplace_back(settings_.side, settings_.gap); }

  std::optional<Place> place(Shape& shape) {
    for (int map = 0; map < count(); ++map)
      if (const auto place = placeIn(map, shape)) return place;
    return std::nullopt;
  }

 private:
  std::optional<Place> placeIn(int map, Shape& shape) {
    std::optional<Place> best;
    const Turned* bestTurned = nullptr;
    int top = settings_.side + 1;  // to get below
    for (Turned& turned : shape) {
      turned.fromRows.resize(maps_.size(), 0);
      int& from = turned.fromRows[static_cast<std::size_t>(map)];
      const int end = top - turned.size.y;
      if (from >= end) continue;
      const auto corner = at(map).find(turned.squares, turned.size, from, end);
      from = corner ? corner->y : end;
      if (!corner) continue;
      best = turned.turn;
      best->map = map, best->corner = *corner;
      bestTurned = &turned, top = corner->y + turned.size.y;
    }
    if (best) at(map).take(bestTurned->squares, bestTurned->size, best->corner);
    return best;
  }
  FreeSquares& at(int map) { return maps_[static_cast<std::size_t>(map)]; }

  PackSettings settings_;
  std::vector<FreeSquares> maps_;
};

// With their gaps.
double texelsOf(std::span<const TexelMask> masks, int gap) {
  double texels = 0;
  for (const TexelMask& mask : masks)
    texels += static_cast<double>(mask.count()) +
              static_cast<double>(gap) * (mask.size().x + mask.size().y + gap);
  return texels;
}

}  // namespace

Result<Packing> packMasks(std::span<const TexelMask> masks, const PackSettings& settings) {
  std::vector<ivec2> sizes;
  for (const TexelMask& mask : masks) sizes.push_back(mask.size());
  LUCERNA_TRY_VOID(eachFits(sizes, settings));
  Packing packing;
  packing.places.resize(masks.size());
  Maps maps(settings);
  Shape shape;
  const TexelMask* last = nullptr;
  Progress progress("packing charts", masks.size());
  for (const std::uint32_t index : packingOrder(masks)) {
    LUCERNA_TRY_VOID(checkGoesOn());
    progress.advance();
    if (last == nullptr || *last != masks[index]) shape = shapeOf(masks[index]);
    last = &masks[index];
    auto place = maps.place(shape);
    if (!place) {
      if (maps.count() == settings.mostMaps)
        return tooManyMaps(masks.size(), texelsOf(masks, settings.gap), settings);
      maps.add();
      place = maps.place(shape);
    }
    packing.places[index] = *place;
  }
  packing.maps = maps.count();
  return packing;
}

Result<PackedCharts> packCharts(std::span<const std::span<const FlatTriangle>> charts,
                                const PackSettings& settings) {
  std::vector<ivec2> sizes;
  for (const auto& chart : charts) sizes.push_back(coverageSize(chart));
  LUCERNA_TRY_VOID(eachFits(sizes, settings));
  PackedCharts packed;
  for (const auto& chart : charts) {
    Coverage coverage = coverageOf(chart);
    packed.least.push_back(coverage.least);
    packed.masks.push_back(std::move(coverage.mask));
  }
  LUCERNA_TRY(packing, packMasks(packed.masks, settings));
  packed.packing = std::move(packing);
  return packed;
}

double occupancy(const Packing& packing, std::span<const TexelMask> masks, int side) {
  const int counted = std::max(packing.maps - 1, 1);
  std::int64_t covered = 0;
  for (std::size_t i = 0; i < masks.size(); ++i)
    if (packing.places[i].map < counted) covered += masks[i].count();
  return static_cast<double>(covered) / (static_cast<double>(counted) * side * side);
}

}  // namespace lucerna::bake
