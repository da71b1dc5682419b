// Texels of the maps in sparse tiles, as floats: patches in the making.
#pragma once

#include <span>
#include <unordered_map>
#include <vector>

#include "lightmap/patch.hpp"

namespace lucerna::lightmap {

// One thread's: looking up remembers the last tile.
class TexelTiles {
 public:
  struct Tile {
    TilePlace place;
    std::uint64_t mask = 0;  // as LightTile::mask
  };

  explicit TexelTiles(std::size_t channels) : channels_(channels) {}

  // Channel c of the texel is at [c * kTileTexels]. nullptr: nothing was said of it.
  const float* find(std::uint16_t map, int x, int y);
  // Says something of the texel, 0 until it is written. Valid until the next call.
  float* add(std::uint16_t map, int x, int y);

  std::size_t channels() const { return channels_; }
  std::span<const Tile> tiles() const { return tiles_; }  // in the order they came
  bool has(TilePlace place) const { return slots_.contains(key(place)); }

  // Values must not be negative.
  TileLight encoded() const;

 private:
  static constexpr std::size_t kNone = ~std::size_t{0};
  static std::uint64_t key(TilePlace place) {
    return std::uint64_t{place.map} << 32 | std::uint64_t{place.y} << 16 | place.x;
  }
  std::size_t slot(TilePlace place);
  float* texel(std::size_t slot, int bit) {
    return &values_[slot * channels_ * kTileTexels + static_cast<std::size_t>(bit)];
  }
  void encode(std::size_t slot, TileLight& light) const;

  std::size_t channels_;
  std::vector<Tile> tiles_;
  std::vector<float> values_;  // as TileLight::values
  std::unordered_map<std::uint64_t, std::size_t> slots_;
  TilePlace lastPlace_;
  std::size_t lastSlot_ = kNone;  // kNone: lastPlace_ is no tile's
};

}  // namespace lucerna::lightmap
