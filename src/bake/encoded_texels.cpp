#include "bake/encoded_texels.hpp"

#include <algorithm>

#include "core/check.hpp"
#include "core/parallel.hpp"
#include "image/bc6h.hpp"
#include "image/rgb9e5.hpp"

namespace lucerna::bake {
namespace {

constexpr int kBlock = 4;  // texels along a block of BC6H
constexpr std::size_t kGrain = 256;

vec3 texelOf(const Image& map, int x, int y) {
  const auto* p = map.pixel<std::uint16_t>(x, y);
  return {floatFromHalf(p[0]), floatFromHalf(p[1]), floatFromHalf(p[2])};
}

TexelPlace blockOf(TexelPlace p) {
  return {.map = p.map,
          .x = static_cast<std::uint16_t>(p.x / kBlock),
          .y = static_cast<std::uint16_t>(p.y / kBlock)};
}

// Half bits of linear values, as the maps' are.
Bc6hTexels decodedBlock(const Image& map, TexelPlace block) {
  Image cut(kBlock, kBlock, 3, ComponentType::Half);
  for (int y = 0; y < kBlock; ++y)
    for (int x = 0; x < kBlock; ++x)
      std::ranges::copy_n(
          map.pixel<std::uint16_t>(std::min(kBlock * block.x + x, map.width() - 1),
                                   std::min(kBlock * block.y + y, map.height() - 1)),
          3, cut.pixel<std::uint16_t>(x, y));
  const Bytes bytes = encodeBc6h(cut);
  return decodeBc6hBlock(std::span(bytes).first<16>());
}

std::vector<vec3> bc6hTexels(const std::vector<Image>& maps, std::span<const TexelPlace> places) {
  std::vector<TexelPlace> blocks;
  for (const TexelPlace& p : places) blocks.push_back(blockOf(p));
  std::ranges::sort(blocks);
  blocks.erase(std::ranges::unique(blocks).begin(), blocks.end());
  std::vector<Bc6hTexels> decoded(blocks.size());
  parallelFor(blocks.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      decoded[i] = decodedBlock(maps[blocks[i].map], blocks[i]);
  });
  std::vector<vec3> values;
  values.reserve(places.size());
  for (const TexelPlace& p : places) {
    const auto at = std::ranges::lower_bound(blocks, blockOf(p)) - blocks.begin();
    const auto& rgb = decoded[static_cast<std::size_t>(at)][p.y % kBlock * kBlock + p.x % kBlock];
    values.emplace_back(floatFromHalf(rgb[0]), floatFromHalf(rgb[1]), floatFromHalf(rgb[2]));
  }
  return values;
}

}  // namespace

std::vector<vec3> encodedTexels(const std::vector<Image>& maps, std::span<const TexelPlace> places,
                                Encoding encoding) {
  if (encoding == Encoding::Bc6h) return bc6hTexels(maps, places);
  std::vector<vec3> values;
  values.reserve(places.size());
  for (const TexelPlace& p : places) {
    const vec3 value = texelOf(maps[p.map], p.x, p.y);
    values.push_back(encoding == Encoding::Rgb9e5 ? fromRgb9e5(toRgb9e5(value)) : value);
  }
  return values;
}

}  // namespace lucerna::bake
