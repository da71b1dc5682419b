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

}  // namespace

std::size_t TexelTiles::slot(TilePlace place) {
  if (lastSlot_ != kNone && lastPlace_ == place) return lastSlot_;
  const auto found = slots_.find(key(place));
  lastPlace_ = place;
  lastSlot_ = found == slots_.end() ? kNone : found->second;
  return lastSlot_;
}

const float* TexelTiles::find(std::uint16_t map, int x, int y) {
  const std::size_t at = slot(placeOf(map, x, y));
  const int bit = bitOf(x, y);
  return at == kNone || (tiles_[at].mask >> bit & 1) == 0 ? nullptr : texel(at, bit);
}

float* TexelTiles::add(std::uint16_t map, int x, int y) {
  const TilePlace place = placeOf(map, x, y);
  if (slot(place) == kNone) {
    lastSlot_ = tiles_.size();
    slots_.emplace(key(place), lastSlot_);
    tiles_.push_back({place, 0});
    values_.resize(values_.size() + channels_ * kTileTexels, 0.f);
  }
  const int bit = bitOf(x, y);
  tiles_[lastSlot_].mask |= std::uint64_t{1} << bit;
  return texel(lastSlot_, bit);
}

void TexelTiles::encode(std::size_t slot, TileLight& light) const {
  const std::span values =
      std::span(values_).subspan(slot * channels_ * kTileTexels, channels_ * kTileTexels);
  const float scale = *std::max_element(values.begin(), values.end()) / kLargest;
  light.tiles.push_back({tiles_[slot].place, scale, tiles_[slot].mask});
  for (const float value : values)
    light.values.push_back(
        scale > 0.f ? static_cast<std::uint16_t>(std::min(value / scale, kLargest) + 0.5f)
                    : std::uint16_t{0});
}

TileLight TexelTiles::encoded() const {
  std::vector<std::size_t> order(tiles_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return tiles_[a].place < tiles_[b].place; });
  TileLight light;
  light.values.reserve(values_.size());
  for (const std::size_t slot : order) encode(slot, light);
  return light;
}

}  // namespace lucerna::lightmap
