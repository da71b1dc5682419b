#include "image/bc6h.hpp"

#include <algorithm>

#include "core/check.hpp"
#include "core/parallel.hpp"
#include "image/bc6h_format.hpp"

namespace lucerna {
namespace {

constexpr std::size_t kRowGrain = 1;  // rows of blocks

std::uint16_t halfWithin(float value) {
  return halfFromFloat(value > 0.f ? std::min(value, kLargestBc6h) : 0.f);  // NaN: 0
}

template <typename T, typename ToHalf>
Bc6hTexels texelsAt(const Image& image, int left, int top, ToHalf toHalf) {
  Bc6hTexels texels;
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 4; ++x) {
      const T* pixel = image.pixel<T>(std::min(left + x, image.width() - 1),
                                      std::min(top + y, image.height() - 1));
      for (int c = 0; c < 3; ++c) texels[4 * y + x][c] = toHalf(pixel[c]);
    }
  return texels;
}

Bc6hTexels texelsAt(const Image& image, int left, int top) {
  if (image.type() == ComponentType::F32) return texelsAt<float>(image, left, top, halfWithin);
  return texelsAt<std::uint16_t>(
      image, left, top, [](std::uint16_t bits) { return halfWithin(floatFromHalf(bits)); });
}

void putTexels(const Bc6hTexels& texels, Image& image, int left, int top) {
  for (int y = 0; y < std::min(4, image.height() - top); ++y)
    for (int x = 0; x < std::min(4, image.width() - left); ++x)
      for (int c = 0; c < 3; ++c)
        image.pixel<float>(left + x, top + y)[c] = floatFromHalf(texels[4 * y + x][c]);
}

// What the indices of a region stand for.
struct Palette {
  std::array<std::array<std::uint16_t, 3>, 16> colors;
};

Palette paletteOf(const bc6h::Fields& fields, int region) {
  const bc6h::Mode& mode = bc6h::kModeTable[fields.mode];
  const std::span<const int> weights = bc6h::weightsOf(mode.regions);
  Palette palette;
  for (int c = 0; c < 3; ++c) {
    const int first = bc6h::unquantized(fields.endpoints[2 * region][c], mode.endpointBits),
              second = bc6h::unquantized(fields.endpoints[2 * region + 1][c], mode.endpointBits);
    for (std::size_t i = 0; i < weights.size(); ++i)
      palette.colors[i][c] = bc6h::halfOf(first, second, weights[i]);
  }
  return palette;
}

}  // namespace

Bc6hTexels decodeBc6hBlock(std::span<const std::byte, 16> block) {
  const std::optional<bc6h::Fields> fields = bc6h::unpack(block);
  if (!fields) return {};
  std::array<Palette, 2> palettes;
  for (int region = 0; region < bc6h::kModeTable[fields->mode].regions; ++region)
    palettes[region] = paletteOf(*fields, region);
  Bc6hTexels texels;
  for (int t = 0; t < bc6h::kTexels; ++t)
    texels[t] = palettes[fields->regionOf(t)].colors[fields->indices[t]];
  return texels;
}

Bytes encodeBc6h(const Image& image) {
  CHECK(!image.empty() && image.channels() >= 3, "{} channels", image.channels());
  CHECK(image.type() == ComponentType::F32 || image.type() == ComponentType::Half);
  const int columns = (image.width() + 3) / 4, rows = (image.height() + 3) / 4;
  Bytes bytes(bc6hBytes(image.width(), image.height()));
  parallelFor(static_cast<std::size_t>(rows), kRowGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; ++row)
      for (int column = 0; column < columns; ++column) {
        const Bc6hBlock block =
            encodeBc6hBlock(texelsAt(image, 4 * column, 4 * static_cast<int>(row)));
        std::ranges::copy(block, bytes.begin() + static_cast<std::ptrdiff_t>(
                                                     (row * columns + column) * block.size()));
      }
  });
  return bytes;
}

Image decodeBc6h(std::span<const std::byte> blocks, int width, int height) {
  CHECK(blocks.size() == bc6hBytes(width, height), "{} bytes for {}x{}", blocks.size(), width,
        height);
  Image image(width, height, 3, ComponentType::F32);
  const int columns = (width + 3) / 4, rows = (height + 3) / 4;
  parallelFor(static_cast<std::size_t>(rows), kRowGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; ++row)
      for (int column = 0; column < columns; ++column) {
        const auto block = blocks.subspan((row * columns + column) * 16).first<16>();
        putTexels(decodeBc6hBlock(block), image, 4 * column, 4 * static_cast<int>(row));
      }
  });
  return image;
}

}  // namespace lucerna
