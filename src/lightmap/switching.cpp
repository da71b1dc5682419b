#include "lightmap/switching.hpp"

#include <algorithm>
#include <cmath>

#include "core/parallel.hpp"
#include "lightmap/unpack.hpp"

namespace lucerna::lightmap {
namespace {

constexpr std::size_t kTileValues = 3 * kTileTexels;
constexpr int kSumBits = 30;
constexpr float kLargest = 65535.f;
constexpr double kLeast = 1e-20;  // irradiance; what never becomes brighter is dark

Status checkFits(const Patch& patch, std::span<const Image> maps) {
  if (patch.maps != static_cast<int>(maps.size()) ||
      (!maps.empty() && patch.side != maps[0].width()))
    return error(ErrorKind::Input,
                 "the patch of group '{}' is of {} maps of {} texels a side, found {} of {}; bake "
                 "the scene again",
                 patch.group, patch.maps, patch.side, maps.size(),
                 maps.empty() ? 0 : maps[0].width());
  return {};
}

// The innermost loop of all: 64 values, so that it becomes vector code without a remainder. The
// same values and factor give the same numbers, whatever their sign.
template <int kSign>
void addTile(std::int32_t* sums, const std::uint16_t* values, float factor) {
  for (int i = 0; i < kTileTexels; ++i)
    sums[i] += kSign * static_cast<std::int32_t>(static_cast<float>(values[i]) * factor + 0.5f);
}

// Calls visit(index in the map's floats, index in a tile's values) for texels within the map.
template <typename Visit>
void forTexelsOf(TilePlace place, int side, Visit visit) {
  const int left = place.x * kTileSide, top = place.y * kTileSide;
  for (int y = 0; y < std::min(kTileSide, side - top); ++y)
    for (int x = 0; x < std::min(kTileSide, side - left); ++x)
      visit((static_cast<std::size_t>(top + y) * side + left + x) * 3,
            static_cast<std::size_t>(y * kTileSide + x));
}

}  // namespace

Result<SwitchedMaps> SwitchedMaps::create(std::vector<Image> maps, std::span<const Patch> patches) {
  for (const Image& map : maps)
    CHECK(map.type() == ComponentType::F32 && map.channels() == 3 && map.width() == map.height() &&
          map.width() == maps[0].width());
  SwitchedMaps switched;
  for (const Patch& patch : patches) LUCERNA_TRY_VOID(checkFits(patch, maps));
  switched.switches_.resize(patches.size());
  parallelFor(patches.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) switched.switches_[i] = switchFor(patches[i]);
  });
  switched.maps_ = std::move(maps);
  switched.addSlots();
  switched.chooseResolution();
  switched.keepBase();
  return switched;
}

SwitchedMaps::Switch SwitchedMaps::switchFor(const Patch& patch) {
  const float own = std::max({patch.color.x, patch.color.y, patch.color.z});
  return {.group = patch.group,
          .light = unpacked(patch),
          .slots = {},
          .channels = patch.channels,
          .most = kHeadroom * (own > 0.f ? own : 1.f)};
}

void SwitchedMaps::addSlots() {
  for (const Switch& patch : switches_)
    for (const LightTile& tile : patch.light.tiles) places_.push_back(tile.place);
  std::sort(places_.begin(), places_.end());
  places_.erase(std::unique(places_.begin(), places_.end()), places_.end());
  for (Switch& patch : switches_)
    for (const LightTile& tile : patch.light.tiles)
      patch.slots.push_back(static_cast<std::uint32_t>(
          std::lower_bound(places_.begin(), places_.end(), tile.place) - places_.begin()));
}

void SwitchedMaps::chooseResolution() {
  std::vector<double> most(places_.size(), 0.);
  for (const Switch& patch : switches_)
    for (std::size_t i = 0; i < patch.slots.size(); ++i)
      most[patch.slots[i]] += double{patch.light.tiles[i].scale} * kLargest * patch.most;
  const double all = most.empty() ? 0. : *std::max_element(most.begin(), most.end());
  // The bit above kSumBits is room for what rounding adds.
  if (all > kLeast)
    resolution_ = static_cast<float>(std::ldexp(1., std::ilogb(all) + 1 - kSumBits));
  CHECK(std::isfinite(resolution_), "{} patches of {} at most", switches_.size(), all);
}

void SwitchedMaps::keepBase() {
  base_.assign(places_.size() * kTileValues, 0.f);
  sums_.assign(places_.size() * kTileValues, 0);
  changed_.assign(places_.size(), 0);
  for (std::size_t slot = 0; slot < places_.size(); ++slot) {
    const Image& map = maps_[places_[slot].map];
    const std::span<const float> values = map.as<float>();
    float* base = &base_[slot * kTileValues];
    forTexelsOf(places_[slot], map.width(), [&](std::size_t from, std::size_t to) {
      for (std::size_t c = 0; c < 3; ++c) base[c * kTileTexels + to] = values[from + c];
    });
  }
}

Status SwitchedMaps::set(std::size_t patch, vec3 color) {
  CHECK(patch < switches_.size());
  Switch& changed = switches_[patch];
  for (int i = 0; i < 3; ++i)
    if (!(color[i] >= 0.f && color[i] <= changed.most))
      return error(ErrorKind::Usage,
                   "the colour of group '{}' has a channel of {}, wanted 0 to {} ({} times the "
                   "group's own)",
                   changed.group, color[i], changed.most, kHeadroom);
  if (color == changed.color) return {};
  add(changed, -1);
  changed.color = color;
  add(changed, 1);
  return {};
}

void SwitchedMaps::add(const Switch& patch, int sign) {
  for (std::size_t c = 0; c < 3; ++c) {
    const float color = patch.color[static_cast<int>(c)];
    if (color == 0.f) continue;
    for (std::size_t i = 0; i < patch.slots.size(); ++i) {
      const std::size_t from = i * patch.channels + (patch.channels == 3 ? c : 0);
      const std::uint16_t* values = &patch.light.values[from * kTileTexels];
      std::int32_t* sums = &sums_[patch.slots[i] * kTileValues + c * kTileTexels];
      const float factor = patch.light.tiles[i].scale * color / resolution_;
      if (sign > 0)
        addTile<1>(sums, values, factor);
      else
        addTile<-1>(sums, values, factor);
      changed_[patch.slots[i]] = 1;
    }
  }
}

void SwitchedMaps::write(std::size_t slot) {
  Image& map = maps_[places_[slot].map];
  const std::span<float> values = map.as<float>();
  const float* base = &base_[slot * kTileValues];
  const std::int32_t* sums = &sums_[slot * kTileValues];
  forTexelsOf(places_[slot], map.width(), [&](std::size_t to, std::size_t from) {
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t i = c * kTileTexels + from;
      // Of a base of -0 a sum would make 0.
      values[to + c] = sums[i] == 0 ? base[i] : base[i] + static_cast<float>(sums[i]) * resolution_;
    }
  });
}

std::vector<TilePlace> SwitchedMaps::update() {
  std::vector<TilePlace> touched;
  for (std::size_t slot = 0; slot < places_.size(); ++slot) {
    if (changed_[slot] == 0) continue;
    changed_[slot] = 0;
    touched.push_back(places_[slot]);
    write(slot);
  }
  return touched;
}

}  // namespace lucerna::lightmap
