#include "bake/make_patch.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "bake/fit_triangles.hpp"
#include "lightmap/unpack.hpp"

namespace lucerna::bake {
namespace {

using lightmap::kTileSide;
using lightmap::kTileTexels;
using lightmap::Patch;
using lightmap::TexelTiles;

// How light becomes values: value times color is light.
struct Channels {
  std::size_t count = 1;
  vec3 color{1.f};      // of the patch
  vec3 weights{1.f};    // light that one of each channel's values is at most
  float leftOut = 0.f;  // irradiance by which one channel alone is off
};

float largestOf(vec3 v) {
  return std::max({v.x, v.y, v.z});
}

float valueOf(vec3 light, vec3 color) {
  return glm::dot(light, color) / glm::dot(color, color);
}

Channels channelsFor(const PatchLight& light, float tolerance) {
  const vec3 color = largestOf(light.color) > 0.f ? light.color : vec3(1.f);
  float off = 0.f;
  for (const PatchTexel& texel : light.texels)
    off = std::max(off, largestOf(glm::abs(texel.value - valueOf(texel.value, color) * color)));
  if (off <= tolerance / 8.f)
    return {.count = 1, .color = color, .weights = vec3(largestOf(color)), .leftOut = off};
  vec3 each = color;
  for (int c = 0; c < 3; ++c)
    if (!(each[c] > 0.f)) each[c] = 1.f;
  return {.count = 3, .color = each, .weights = each};
}

TexelTiles valuesOf(const PatchLight& light, const Channels& channels, float black) {
  TexelTiles values(channels.count);
  for (const PatchTexel& texel : light.texels) {
    if (!(largestOf(texel.value) > black)) continue;
    float* to = values.add(texel.map, texel.x, texel.y);
    if (channels.count == 1) {
      *to = std::max(valueOf(texel.value, channels.color), 0.f);
      continue;
    }
    for (int c = 0; c < 3; ++c)
      to[c * kTileTexels] = std::max(texel.value[c], 0.f) / channels.color[c];
  }
  return values;
}

// Light by which two texels differ; nullptr is a dark one.
float difference(const float* a, const float* b, const Channels& channels) {
  float worst = 0.f;
  for (std::size_t c = 0; c < channels.count; ++c) {
    const std::size_t at = c * kTileTexels;
    const float off = (a == nullptr ? 0.f : a[at]) - (b == nullptr ? 0.f : b[at]);
    worst = std::max(worst, std::abs(off) * channels.weights[static_cast<int>(c)]);
  }
  return worst;
}

// Calls visit(map, x, y, a's values, b's) for texels of which either says something.
template <typename Visit>
void forEither(TexelTiles& a, TexelTiles& b, Visit visit) {
  const auto forTexelsOf = [&](const TexelTiles::Tile& tile, bool ofB) {
    for (std::uint64_t left = tile.mask; left != 0; left &= left - 1) {
      const int bit = std::countr_zero(left);
      const int x = tile.place.x * kTileSide + bit % kTileSide,
                y = tile.place.y * kTileSide + bit / kTileSide;
      const float* inA = a.find(tile.place.map, x, y);
      if (ofB && inA != nullptr) continue;  // visited as a's
      visit(tile.place.map, x, y, inA, b.find(tile.place.map, x, y));
    }
  };
  for (const TexelTiles::Tile& tile : a.tiles()) forTexelsOf(tile, false);
  for (const TexelTiles::Tile& tile : b.tiles()) forTexelsOf(tile, true);
}

class Making {
 public:
  Making(TexelTiles& wanted, const Channels& channels, std::span<const std::vector<bool>> used,
         int side)
      : wanted_(wanted), channels_(channels), used_(used), side_(side) {}

  bool isUsed(std::uint16_t map, int x, int y) const {
    return used_[map][static_cast<std::size_t>(y) * side_ + x];
  }

  // Texels that triangles give wrongly.
  lightmap::TileLight leftOver(const Patch& patch, float tolerance) {
    TexelTiles got = lightmap::lightOfTriangles(patch), left(channels_.count);
    forEither(wanted_, got,
              [&](std::uint16_t map, int x, int y, const float* wanted, const float* found) {
                if (wanted == nullptr && !isUsed(map, x, y)) return;
                if (found != nullptr && difference(wanted, found, channels_) <= tolerance) return;
                float* to = left.add(map, x, y);
                for (std::size_t c = 0; c < channels_.count; ++c)
                  to[c * kTileTexels] = wanted == nullptr ? 0.f : wanted[c * kTileTexels];
              });
    return left.encoded();
  }

  // The largest difference of a used texel from the light that the group gives.
  float worstOf(const Patch& patch, std::span<const PatchTexel> lit) {
    TexelTiles got = lightmap::decoded(lightmap::unpacked(patch), channels_.count);
    float worst = 0.f;
    for (const PatchTexel& texel : lit) {
      vec3 light(0.f);
      if (const float* found = got.find(texel.map, texel.x, texel.y))
        for (int c = 0; c < 3; ++c)
          light[c] = patch.color[c] * found[channels_.count == 1 ? 0 : c * kTileTexels];
      worst = std::max(worst, largestOf(glm::abs(light - texel.value)));
    }
    forEither(wanted_, got,
              [&](std::uint16_t map, int x, int y, const float* wanted, const float* found) {
                if (wanted == nullptr && isUsed(map, x, y))
                  worst = std::max(worst, difference(nullptr, found, channels_));
              });
    return worst;
  }

 private:
  TexelTiles& wanted_;
  const Channels& channels_;
  std::span<const std::vector<bool>> used_;
  int side_;
};

}  // namespace

PatchMaker::PatchMaker(const lightmap::Layout& layout, std::span<const std::vector<bool>> used)
    : side_(layout.side), maps_(layout.maps), used_(used), roots_(rootsOf(layout)) {
  CHECK(used.size() == static_cast<std::size_t>(maps_));
  for (const std::vector<bool>& map : used)
    CHECK(map.size() == static_cast<std::size_t>(side_) * side_);
}

MadePatch PatchMaker::make(const PatchLight& light, const PatchTolerance& tolerance) const {
  CHECK(tolerance.black <= tolerance.light);
  const Channels channels = channelsFor(light, tolerance.light);
  TexelTiles values = valuesOf(light, channels, tolerance.black);
  Making making(values, channels, used_, side_);
  // Where one channel is not quite the colour, that is of the tolerance.
  const float allowed = tolerance.light - channels.leftOut;

  Patch tiles{.group = light.group,
              .color = channels.color,
              .side = side_,
              .maps = maps_,
              .channels = static_cast<std::uint8_t>(channels.count)};
  Patch triangles = tiles;
  tiles.tiles = values.encoded();
  triangles.least = tolerance.black / largestOf(channels.weights);
  triangles.triangles = fitTriangles(
      roots_, values, {.tolerance = allowed / channels.weights, .side = side_, .used = used_});
  // 16 bits round what is left over, and all of it once more when it is unpacked.
  triangles.tiles = making.leftOver(triangles, allowed * 0.99f);

  MadePatch ofTiles{.patch = std::move(tiles)}, ofTriangles{.patch = std::move(triangles)};
  for (MadePatch* made : {&ofTiles, &ofTriangles}) {
    made->bytes = toBytes(made->patch);
    made->worst = making.worstOf(made->patch, light.texels);
  }
  const bool good = ofTriangles.worst <= std::max(tolerance.light, ofTiles.worst);
  MadePatch& kept = good && ofTriangles.bytes.size() < ofTiles.bytes.size() ? ofTriangles : ofTiles;
  kept.otherBytes = (&kept == &ofTiles ? ofTriangles : ofTiles).bytes.size();
  return std::move(kept);
}

}  // namespace lucerna::bake
