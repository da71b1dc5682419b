#include "lightmap/texel_tiles.hpp"

#include <algorithm>
#include <numeric>

namespace lucerna::lightmap {
namespace {

constexpr float kLargest = 65535.f;

TilePlace placeOf(std::uint16_t map, int x, int y) {
  return {map, static_cast<std::uint16_t>(x / kTileSide),
          static_cast<std::uint16_t>(y / kTileSide)};
}

int bitOf(int x, int y) {
  return y % kTileSide * kTileSide + x % kTileSide;
}

void encode(const TexelTiles::Tile& tile, std::span<const float> values, TileLight& light) {
  const float scale = *std::ranges::max_element(values) / kLargest;
  light.tiles.push_back({tile.place, scale, tile.mask});
  for (const float value : values)
    light.values.push_back(
        scale > 0.f ? static_cast<std::uint16_t>(std::min(value / scale, kLargest) + 0.5f)
                    : std::uint16_t{0});
}

}  // namespace

template <typename Value>
std::size_t TilesOf<Value>::slot(TilePlace place) {
  if (lastSlot_ != kNone && lastPlace_ == place) return lastSlot_;
  const auto found = slots_.find(key(place));
  lastPlace_ = place;
  lastSlot_ = found == slots_.end() ? kNone : found->second;
  return lastSlot_;
}

template <typename Value>
const Value* TilesOf<Value>::find(std::uint16_t map, int x, int y) {
  const std::size_t at = slot(placeOf(map, x, y));
  const int bit = bitOf(x, y);
  return at == kNone || (tiles_[at].mask >> bit & 1) == 0 ? nullptr : &values(at)[bit];
}

template <typename Value>
Value* TilesOf<Value>::add(std::uint16_t map, int x, int y) {
  const TilePlace place = placeOf(map, x, y);
  if (slot(place) == kNone) {
    lastSlot_ = tiles_.size();
    slots_.emplace(key(place), static_cast<std::uint32_t>(lastSlot_));
    tiles_.push_back({place, 0});
    if (lastSlot_ % kChunk == 0) chunks_.emplace_back(kChunk * perTile());
  }
  const int bit = bitOf(x, y);
  tiles_[lastSlot_].mask |= std::uint64_t{1} << bit;
  return &values(lastSlot_)[bit];
}

template <typename Value>
std::vector<std::uint32_t> TilesOf<Value>::sorted() const {
  std::vector<std::uint32_t> order(tiles_.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::sort(order, {}, [&](std::uint32_t slot) { return tiles_[slot].place; });
  return order;
}

template class TilesOf<float>;
template class TilesOf<std::uint16_t>;

TileLight encoded(const TexelTiles& texels) {
  TileLight light;
  light.values.reserve(texels.tiles().size() * texels.channels() * kTileTexels);
  for (const std::uint32_t slot : texels.sorted())
    encode(texels.tiles()[slot], texels.values(slot), light);
  return light;
}

}  // namespace lucerna::lightmap
