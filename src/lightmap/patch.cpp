#include "lightmap/patch.hpp"

#include <algorithm>
#include <bit>

#include "core/byte_stream.hpp"

namespace lucerna::lightmap {
namespace {

constexpr std::uint64_t kMagic = 0x31'68'63'74'61'50'4c'4cull;  // "LLPatch1"
constexpr float kMostLight = 1e12f;  // what is made of these stays a float
constexpr int kMostSide = 32768, kMostMaps = 65536;

// The same members in the same order, written or read. `present` holds the values of tiles that
// their masks name.
template <typename Stream, typename P, typename Values>
void fields(Stream& stream, P& patch, Values& present) {
  stream(patch.group);
  for (int i = 0; i < 3; ++i) stream(patch.color[i]);
  stream(patch.side);
  stream(patch.maps);
  stream(patch.channels);
  stream(patch.least);
  stream.list(patch.triangles.roots, [](auto& s, auto& root) {
    s(root.map);
    s(root.borders);
    s(root.scale);
    for (auto& corner : root.corners) s(corner);
  });
  stream.list(patch.triangles.nodes, [](auto& s, auto& node) { s.choice(node, 3); });
  stream(patch.triangles.values);
  stream.list(patch.tiles.tiles, [](auto& s, auto& tile) {
    s(tile.place.map);
    s(tile.place.x);
    s(tile.place.y);
    s(tile.scale);
    s(tile.mask);
  });
  stream(present);
}

// Calls visit(index in values) for each value of a texel in its tile's mask.
template <typename Visit>
void forPresent(const Patch& patch, Visit visit) {
  for (std::size_t t = 0; t < patch.tiles.tiles.size(); ++t)
    for (std::size_t c = 0; c < patch.channels; ++c)
      for (std::uint64_t left = patch.tiles.tiles[t].mask; left != 0; left &= left - 1)
        visit((t * patch.channels + c) * kTileTexels +
              static_cast<std::size_t>(std::countr_zero(left)));
}

bool isLight(float value) {
  return value >= 0.f && value <= kMostLight;
}

bool isColor(vec3 color) {
  return isLight(color.x) && isLight(color.y) && isLight(color.z);
}

// The nodes of one root, from `next` on.
bool skipTree(std::span<const PatchNode> nodes, std::size_t& next, std::size_t& leaves, int depth) {
  if (next == nodes.size()) return false;
  const PatchNode node = nodes[next++];
  if (node == PatchNode::Leaf) ++leaves;
  if (node != PatchNode::Split) return true;
  if (depth == kMostSplits) return false;
  for (int i = 0; i < 4; ++i)
    if (!skipTree(nodes, next, leaves, depth + 1)) return false;
  return true;
}

bool isSound(const TriangleLight& light, const Patch& patch) {
  const int most = patch.side * kPatchUnit;
  std::size_t next = 0, leaves = 0;
  for (const PatchRoot& root : light.roots) {
    if (root.map >= patch.maps || root.borders > 7 || !isLight(root.scale)) return false;
    for (const ivec2 p : root.corners)
      if (p.x < 0 || p.y < 0 || p.x > most || p.y > most) return false;
    if (!skipTree(light.nodes, next, leaves, 0)) return false;
  }
  return next == light.nodes.size() && light.values.size() == leaves * 3 * patch.channels;
}

// Bits of a tile's texels that lie in the map.
std::uint64_t maskWithin(const TilePlace& place, int side) {
  std::uint64_t mask = 0;
  for (int i = 0; i < kTileTexels; ++i)
    if (place.x * kTileSide + i % kTileSide < side && place.y * kTileSide + i / kTileSide < side)
      mask |= std::uint64_t{1} << i;
  return mask;
}

bool isSound(const TileLight& light, const Patch& patch) {
  for (std::size_t i = 0; i < light.tiles.size(); ++i) {
    const LightTile& tile = light.tiles[i];
    if (tile.place.map >= patch.maps || !isLight(tile.scale)) return false;
    if (tile.mask == 0 || (tile.mask & ~maskWithin(tile.place, patch.side)) != 0) return false;
    if (i > 0 && !(light.tiles[i - 1].place < tile.place)) return false;
  }
  return true;
}

bool isSound(const Patch& patch) {
  return patch.side >= 1 && patch.side <= kMostSide && patch.maps >= 0 && patch.maps <= kMostMaps &&
         (patch.channels == 1 || patch.channels == 3) && isColor(patch.color) &&
         isLight(patch.least) && isSound(patch.triangles, patch) && isSound(patch.tiles, patch);
}

// Whether as many as the masks say.
bool spread(std::span<const std::uint16_t> present, Patch& patch) {
  std::size_t wanted = 0;
  for (const LightTile& tile : patch.tiles.tiles)
    wanted += static_cast<std::size_t>(std::popcount(tile.mask)) * patch.channels;
  if (wanted != present.size()) return false;
  patch.tiles.values.assign(patch.tiles.tiles.size() * patch.channels * kTileTexels, 0);
  std::size_t next = 0;
  forPresent(patch, [&](std::size_t i) { patch.tiles.values[i] = present[next++]; });
  return true;
}

}  // namespace

Bytes toBytes(const Patch& patch) {
  CHECK(patch.tiles.values.size() == patch.tiles.tiles.size() * patch.channels * kTileTexels);
  std::vector<std::uint16_t> present;
  forPresent(patch, [&](std::size_t i) { present.push_back(patch.tiles.values[i]); });
  ByteWriter writer;
  writer(kMagic);
  fields(writer, patch, present);
  return std::move(writer.bytes);
}

Result<Patch> patchFrom(std::span<const std::byte> bytes, const std::string& name) {
  ByteReader reader(bytes);
  std::uint64_t magic = 0;
  reader(magic);
  if (magic != kMagic)
    return error(ErrorKind::Input, "{}: found no light patch; bake the scene again", name);
  Patch patch;
  std::vector<std::uint16_t> present;
  fields(reader, patch, present);
  if (!reader.good() || !reader.atEnd() || !isSound(patch) || !spread(present, patch))
    return error(ErrorKind::Input, "{}: the light patch is damaged; bake the scene again", name);
  return patch;
}

}  // namespace lucerna::lightmap
