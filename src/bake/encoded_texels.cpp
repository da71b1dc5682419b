#include "bake/encoded_texels.hpp"

#include <algorithm>

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

// One block of a map, encoded and decoded.
Image asBc6h(const Image& map, TexelPlace block) {
  Image cut(kBlock, kBlock, 3, ComponentType::Half);
  for (int y = 0; y < kBlock; ++y)
    for (int x = 0; x < kBlock; ++x)
      std::ranges::copy_n(
          map.pixel<std::uint16_t>(std::min(kBlock * block.x + x, map.width() - 1),
                                   std::min(kBlock * block.y + y, map.height() - 1)),
          3, cut.pixel<std::uint16_t>(x, y));
  return decodeBc6h(encodeBc6h(cut), kBlock, kBlock);
}

// Blocks without any of the places are not encoded, as that takes long.
std::vector<vec3> bc6hTexels(std::span<const Image> maps, std::span<const TexelPlace> places) {
  std::vector<TexelPlace> blocks;
  for (const TexelPlace& p : places) blocks.push_back(blockOf(p));
  std::ranges::sort(blocks);
  const auto again = std::ranges::unique(blocks);
  blocks.erase(again.begin(), again.end());
  std::vector<Image> decoded(blocks.size());
  parallelFor(blocks.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) decoded[i] = asBc6h(maps[blocks[i].map], blocks[i]);
  });
  std::vector<vec3> values;
  values.reserve(places.size());
  for (const TexelPlace& p : places) {
    const auto at = std::ranges::lower_bound(blocks, blockOf(p)) - blocks.begin();
    const float* rgb =
        decoded[static_cast<std::size_t>(at)].pixel<float>(p.x % kBlock, p.y % kBlock);
    values.emplace_back(rgb[0], rgb[1], rgb[2]);
  }
  return values;
}

}  // namespace

std::vector<vec3> encodedTexels(std::span<const Image> maps, std::span<const TexelPlace> places,
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
