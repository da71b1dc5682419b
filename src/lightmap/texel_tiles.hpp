// Texels of the maps in sparse tiles: light in the making.
#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "lightmap/patch.hpp"

namespace lucerna::lightmap {

// Calls visit(x, y, bit) for the texels of a tile's mask: where they lie in the map, and their bit.
template <typename Visit>
void forTexels(TilePlace place, std::uint64_t mask, Visit visit) {
  for (std::uint64_t left = mask; left != 0; left &= left - 1) {
    const int bit = std::countr_zero(left);
    visit(place.x * kTileSide + bit % kTileSide, place.y * kTileSide + bit / kTileSide, bit);
  }
}

// Value: float, or std::uint16_t, as half floats are. One thread's: looking up remembers the last
// tile.
template <typename Value>
class TilesOf {
 public:
  struct Tile {
    TilePlace place;
    std::uint64_t mask = 0;  // as LightTile::mask
  };

  explicit TilesOf(std::size_t channels) : channels_(channels) {}

  // Channel c of the texel is at [c * kTileTexels]. nullptr: nothing was said of it.
  const Value* find(std::uint16_t map, int x, int y);
  // Says something of the texel, 0 until it is written. Stays where it is.
  Value* add(std::uint16_t map, int x, int y);

  std::size_t channels() const { return channels_; }
  std::span<const Tile> tiles() const { return tiles_; }  // in the order they came
  // Of tiles()[slot], as TileLight::values.
  std::span<const Value> values(std::size_t slot) const {
    return {chunks_[slot / kChunk].data() + slot % kChunk * perTile(), perTile()};
  }
  std::span<Value> values(std::size_t slot) {
    return {chunks_[slot / kChunk].data() + slot % kChunk * perTile(), perTile()};
  }
  // Calls visit(map, x, y, its first channel) for the texels of tiles()[slot].
  template <typename Visit>
  void forTexelsOf(std::size_t slot, Visit visit) const {
    const Value* all = values(slot).data();
    forTexels(tiles_[slot].place, tiles_[slot].mask,
              [&](int x, int y, int bit) { visit(tiles_[slot].place.map, x, y, all + bit); });
  }
  template <typename Visit>
  void forTexelsOf(std::size_t slot, Visit visit) {
    Value* all = values(slot).data();
    forTexels(tiles_[slot].place, tiles_[slot].mask,
              [&](int x, int y, int bit) { visit(tiles_[slot].place.map, x, y, all + bit); });
  }
  bool has(TilePlace place) const { return slots_.contains(key(place)); }
  // Slots in the order of their places.
  std::vector<std::uint32_t> sorted() const;

 private:
  static constexpr std::size_t kNone = ~std::size_t{0};
  static constexpr std::size_t kChunk = 64;  // tiles whose values lie together
  static std::uint64_t key(TilePlace place) {
    return std::uint64_t{place.map} << 32 | std::uint64_t{place.y} << 16 | place.x;
  }
  std::size_t perTile() const { return channels_ * kTileTexels; }
  std::size_t slot(TilePlace place);

  std::size_t channels_;
  std::vector<Tile> tiles_;
  std::vector<std::vector<Value>> chunks_;
  std::unordered_map<std::uint64_t, std::uint32_t> slots_;
  TilePlace lastPlace_;
  std::size_t lastSlot_ = kNone;  // kNone: lastPlace_ is no tile's
};

using TexelTiles = TilesOf<float>;
using HalfTiles = TilesOf<std::uint16_t>;
extern template class TilesOf<float>;
extern template class TilesOf<std::uint16_t>;

// Values must not be negative.
TileLight encoded(const TexelTiles& texels);

}  // namespace lucerna::lightmap
