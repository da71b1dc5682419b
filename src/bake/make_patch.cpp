#include "bake/make_patch.hpp"

#include <algorithm>
#include <cmath>

#include "bake/fit_triangles.hpp"
#include "image/image.hpp"
#include "lightmap/unpack.hpp"

namespace lucerna::bake {
namespace {

using lightmap::HalfTiles;
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

// Calls visit(map, x, y, irradiance) for the texels of these tiles.
template <typename Visit>
void forLit(const HalfTiles& texels, std::span<const std::uint32_t> slots, Visit visit) {
  for (const std::uint32_t slot : slots)
    texels.forTexelsOf(slot, [&](std::uint16_t map, int x, int y, const std::uint16_t* red) {
      visit(map, x, y,
            vec3(floatFromHalf(red[0]), floatFromHalf(red[kTileTexels]),
                 floatFromHalf(red[2 * kTileTexels])));
    });
}

Channels channelsFor(const PatchLight& light, std::span<const std::uint32_t> slots,
                     float tolerance) {
  const vec3 color = largestOf(light.color) > 0.f ? light.color : vec3(1.f);
  float off = 0.f;
  forLit(light.irradiance, slots, [&](std::uint16_t, int, int, vec3 lit) {
    off = std::max(off, largestOf(glm::abs(lit - valueOf(lit, color) * color)));
  });
  if (off <= tolerance / 8.f)
    return {.count = 1, .color = color, .weights = vec3(largestOf(color)), .leftOut = off};
  vec3 each = color;
  for (int c = 0; c < 3; ++c)
    if (!(each[c] > 0.f)) each[c] = 1.f;
  return {.count = 3, .color = each, .weights = each};
}

TexelTiles valuesOf(const HalfTiles& texels, std::span<const std::uint32_t> slots,
                    const Channels& channels, float black) {
  TexelTiles values(channels.count);
  forLit(texels, slots, [&](std::uint16_t map, int x, int y, vec3 lit) {
    if (!(largestOf(lit) > black)) return;
    float* to = values.add(map, x, y);
    if (channels.count == 1) {
      *to = std::max(valueOf(lit, channels.color), 0.f);
      return;
    }
    for (int c = 0; c < 3; ++c) to[c * kTileTexels] = std::max(lit[c], 0.f) / channels.color[c];
  });
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
    lightmap::forTexels(tile.place, tile.mask, [&](int x, int y, int) {
      const float* inA = a.find(tile.place.map, x, y);
      if (ofB && inA != nullptr) return;  // visited as a's
      visit(tile.place.map, x, y, inA, b.find(tile.place.map, x, y));
    });
  };
  for (const TexelTiles::Tile& tile : a.tiles()) forTexelsOf(tile, false);
  for (const TexelTiles::Tile& tile : b.tiles()) forTexelsOf(tile, true);
}

// What the patches of one group have in common.
struct Group {
  const HalfTiles& texels;
  Channels channels;
  PatchTolerance tolerance;
  std::span<const std::vector<bool>> used;
  Patch empty;  // of this group, without any light
};

// One map's part of a patch.
class MapPatch {
 public:
  // slots: the tiles of the group's in the map. roots: the map's.
  MapPatch(const Group& group, std::span<const std::uint32_t> slots,
           std::span<const lightmap::PatchRoot> roots)
      : group_(group),
        slots_(slots),
        wanted_(valuesOf(group.texels, slots, group.channels, group.tolerance.black)) {
    // Where one channel is not quite the colour, that is of the tolerance.
    const float allowed = group.tolerance.light - group.channels.leftOut;
    tiles = group.empty;
    triangles = group.empty;
    tiles.tiles = encoded(wanted_);
    triangles.triangles = fitTriangles(roots, wanted_,
                                       {.tolerance = allowed / group.channels.weights,
                                        .side = group.empty.side,
                                        .used = group.used});
    // 16 bits round what is left over, and all of it once more when it is unpacked.
    triangles.tiles = leftOver(allowed * 0.99f);
    worstOfTiles = worstOf(tiles);
    worstOfTriangles = worstOf(triangles);
  }

  Patch tiles, triangles;
  float worstOfTiles = 0.f, worstOfTriangles = 0.f;

 private:
  bool isUsed(std::uint16_t map, int x, int y) const {
    return group_.used[map][static_cast<std::size_t>(y) * group_.empty.side + x];
  }

  // Texels that triangles give wrongly.
  lightmap::TileLight leftOver(float tolerance) {
    const Channels& channels = group_.channels;
    TexelTiles got = lightmap::lightOfTriangles(triangles), left(channels.count);
    forEither(wanted_, got,
              [&](std::uint16_t map, int x, int y, const float* wanted, const float* found) {
                if (wanted == nullptr && !isUsed(map, x, y)) return;
                if (found != nullptr && difference(wanted, found, channels) <= tolerance) return;
                float* to = left.add(map, x, y);
                for (std::size_t c = 0; c < channels.count; ++c)
                  to[c * kTileTexels] = wanted == nullptr ? 0.f : wanted[c * kTileTexels];
              });
    return encoded(left);
  }

  // The largest difference of a used texel from the light that the group gives.
  float worstOf(const Patch& patch) {
    const Channels& channels = group_.channels;
    TexelTiles got = lightmap::decoded(lightmap::unpacked(patch), channels.count);
    float worst = 0.f;
    forLit(group_.texels, slots_, [&](std::uint16_t map, int x, int y, vec3 lit) {
      vec3 light(0.f);
      if (const float* found = got.find(map, x, y))
        for (int c = 0; c < 3; ++c)
          light[c] = patch.color[c] * found[channels.count == 1 ? 0 : c * kTileTexels];
      worst = std::max(worst, largestOf(glm::abs(light - lit)));
    });
    forEither(wanted_, got,
              [&](std::uint16_t map, int x, int y, const float* wanted, const float* found) {
                if (wanted == nullptr && isUsed(map, x, y))
                  worst = std::max(worst, difference(nullptr, found, channels));
              });
    return worst;
  }

  const Group& group_;
  std::span<const std::uint32_t> slots_;
  TexelTiles wanted_;
};

template <typename T>
void append(std::vector<T>& list, const std::vector<T>& more) {
  list.insert(list.end(), more.begin(), more.end());
}

void append(Patch& patch, const Patch& more) {
  append(patch.triangles.roots, more.triangles.roots);
  append(patch.triangles.nodes, more.triangles.nodes);
  append(patch.triangles.values, more.triangles.values);
  append(patch.tiles.tiles, more.tiles.tiles);
  append(patch.tiles.values, more.tiles.values);
}

}  // namespace

PatchMaker::PatchMaker(const lightmap::Layout& layout, std::span<const std::vector<bool>> used)
    : side_(layout.side), maps_(layout.maps), used_(used), roots_(rootsOf(layout)) {
  CHECK(used.size() == static_cast<std::size_t>(maps_));
  for (const std::vector<bool>& map : used)
    CHECK(map.size() == static_cast<std::size_t>(side_) * side_);
  std::ranges::stable_sort(roots_, {}, &lightmap::PatchRoot::map);
}

MadePatch PatchMaker::make(const PatchLight& light, const PatchTolerance& tolerance) const {
  CHECK(tolerance.black <= tolerance.light);
  const HalfTiles& texels = light.irradiance;
  const std::vector<std::uint32_t> slots = texels.sorted();
  const Channels channels = channelsFor(light, slots, tolerance.light);
  Group group{.texels = texels,
              .channels = channels,
              .tolerance = tolerance,
              .used = used_,
              .empty = {.group = light.group,
                        .color = channels.color,
                        .side = side_,
                        .maps = maps_,
                        .channels = static_cast<std::uint8_t>(channels.count),
                        .least = tolerance.black / largestOf(channels.weights)}};

  MadePatch made{.patch = group.empty};
  const std::uint64_t head = toBytes(group.empty).size();
  std::uint64_t ofTiles = head, ofTriangles = head;
  for (std::size_t first = 0, last = 0; first < slots.size(); first = last) {
    const std::uint16_t map = texels.tiles()[slots[first]].place.map;
    while (last < slots.size() && texels.tiles()[slots[last]].place.map == map) ++last;
    const auto roots = std::ranges::equal_range(roots_, map, {}, &lightmap::PatchRoot::map);
    const MapPatch part(group, std::span(slots).subspan(first, last - first), roots);
    const std::uint64_t tiles = toBytes(part.tiles).size(),
                        triangles = toBytes(part.triangles).size();
    const bool good = part.worstOfTriangles <= std::max(tolerance.light, part.worstOfTiles);
    const bool keepsTriangles = good && triangles < tiles;
    append(made.patch, keepsTriangles ? part.triangles : part.tiles);
    made.worst = std::max(made.worst, keepsTriangles ? part.worstOfTriangles : part.worstOfTiles);
    ofTiles += tiles - head;
    ofTriangles += triangles - head;
  }
  if (made.patch.form() == "tiles") made.patch.least = 0.f;  // of triangles
  made.bytes = toBytes(made.patch);
  made.otherBytes = made.patch.form() == "tiles" ? ofTriangles : ofTiles;
  return made;
}

}  // namespace lucerna::bake
