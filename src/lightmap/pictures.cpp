#include "lightmap/pictures.hpp"

#include <cmath>

#include "core/hash.hpp"
#include "image/metrics.hpp"
#include "lightmap/patch_triangle.hpp"

namespace lucerna::lightmap {
namespace {

using Rgb8 = std::array<std::uint8_t, 3>;

constexpr Rgb8 kGreen{60, 150, 80}, kYellow{220, 180, 60}, kGrey{40, 40, 40}, kRed{255, 0, 0},
    kViolet{255, 0, 255}, kWhite{255, 255, 255}, kDark{60, 60, 60}, kBlack{0, 0, 0};

void paint(Image& image, int x, int y, Rgb8 color) {
  std::ranges::copy(color, image.pixel<std::uint8_t>(x, y));
}

// Light enough to stand out from black.
Rgb8 colorOfNumber(std::uint64_t number) {
  const std::uint64_t bits = hashCombine(0x6c'75'63'65'72'6e'61ull, number);
  const auto part = [&](int shift) {
    return static_cast<std::uint8_t>(64 + (bits >> shift & 0xff) * 191 / 255);
  };
  return {part(8), part(24), part(40)};
}

template <typename Color>
Image picture(int side, Color colorAt) {
  Image image(side, side, 3, ComponentType::U8);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) paint(image, x, y, colorAt(x, y));
  return image;
}

bool isSound(const float* rgb) {
  return std::all_of(rgb, rgb + 3, [](float v) { return std::isfinite(v) && v >= 0.f; });
}

void paintTriangle(Image& image, const Patch& patch, std::size_t& node,
                   const PatchTriangle& triangle, bool shown) {
  const std::size_t number = node++;
  switch (patch.triangles.nodes[number]) {
    case PatchNode::Nothing:
      return;
    case PatchNode::Leaf:
      if (shown)
        TriangleTexels(triangle, false, patch.side).forEach([&](int x, int y, vec3) {
          paint(image, x, y, colorOfNumber(number));
        });
      return;
    case PatchNode::Split:
      for (int part = 0; part < 4; ++part)
        paintTriangle(image, patch, node, partOf(triangle, part), shown);
      return;
  }
}

void paintTiles(Image& image, const Patch& patch, int map) {
  const TileLight& light = patch.tiles;
  float brightest = 0.f;
  for (const LightTile& tile : light.tiles) brightest = std::max(brightest, tile.scale);
  const std::size_t perTile = std::size_t{patch.channels} * kTileTexels;
  for (std::size_t i = 0; i < light.tiles.size(); ++i) {
    const LightTile& tile = light.tiles[i];
    if (tile.place.map != map) continue;
    for (int bit = 0; bit < kTileTexels; ++bit) {
      if ((tile.mask >> bit & 1) == 0) continue;
      std::uint16_t value = 0;
      for (std::size_t c = 0; c < patch.channels; ++c)
        value = std::max(value, light.values[i * perTile + c * kTileTexels + bit]);
      const float share = brightest > 0.f ? tile.scale * value / 65535.f / brightest : 0.f;
      const auto grey = static_cast<std::uint8_t>(32.f + 223.f * std::sqrt(std::min(share, 1.f)));
      paint(image, tile.place.x * kTileSide + bit % kTileSide,
            tile.place.y * kTileSide + bit / kTileSide, {grey, grey, grey});
    }
  }
}

}  // namespace

Image tonePicture(const Image& map, float factor) {
  return picture(map.width(), [&](int x, int y) {
    const float* rgb = map.pixel<float>(x, y);
    Rgb8 color{};
    for (std::size_t c = 0; c < 3; ++c) {
      const float shown = std::max(rgb[c], 0.f) / kPi * factor;
      const float value = std::isfinite(shown) ? srgbFromLinear(shown / (1.f + shown)) : 1.f;
      color[c] = static_cast<std::uint8_t>(255.f * value + 0.5f);
    }
    return color;
  });
}

Image chartPicture(const ChartTexels& texels) {
  return picture(texels.side, [&](int x, int y) {
    const std::uint32_t chart = texels.at(x, y);
    return chart == ChartTexels::kNothing ? kBlack : colorOfNumber(chart);
  });
}

Image validityPicture(const ChartTexels& texels, const Image& map) {
  Image image = picture(texels.side, [&](int x, int y) {
    if (!isSound(map.pixel<float>(x, y))) return kViolet;
    if (texels.at(x, y) != ChartTexels::kNothing) return kGreen;
    return texels.isBeside(x, y) ? kYellow : kGrey;
  });
  for (const std::uint32_t at : texels.overlaps)
    paint(image, static_cast<int>(at) % texels.side, static_cast<int>(at) / texels.side, kRed);
  return image;
}

Image seamPicture(const ChartTexels& texels) {
  return picture(texels.side, [&](int x, int y) {
    if (texels.isBorder(x, y)) return kWhite;
    return texels.at(x, y) == ChartTexels::kNothing ? kBlack : kDark;
  });
}

Image densityPicture(const Layout& layout, int map,
                     const std::vector<std::vector<float>>& densities, float wanted) {
  Image heat(layout.side, layout.side, 1, ComponentType::F32);
  Image mask(layout.side, layout.side, 1, ComponentType::U8);
  for (std::size_t i = 0; i < layout.objects.size(); ++i)
    for (std::size_t k = 0; k < layout.objects[i].size(); ++k) {
      const TrianglePlace& place = layout.objects[i][k];
      if (place.map != map || densities[i][k] == 0.f) continue;
      const float stops = std::log2(densities[i][k] / wanted);
      forEachTexel(place.corners, layout.side, [&](int x, int y) {
        *heat.pixel<float>(x, y) = std::clamp(0.5f + 0.25f * stops, 0.f, 1.f);
        *mask.pixel<std::uint8_t>(x, y) = 255;
      });
    }
  return heatMap(heat, &mask);
}

bool lights(const Patch& patch, int map) {
  return std::ranges::any_of(patch.tiles.tiles,
                             [&](const LightTile& t) { return t.place.map == map; }) ||
         std::ranges::any_of(patch.triangles.roots,
                             [&](const PatchRoot& r) { return r.map == map; });
}

Image patchPicture(const Patch& patch, int map) {
  Image image(patch.side, patch.side, 3, ComponentType::U8);
  std::size_t node = 0;
  for (const PatchRoot& root : patch.triangles.roots)
    paintTriangle(image, patch, node, triangleOf(root), root.map == map);
  paintTiles(image, patch, map);
  return image;
}

}  // namespace lucerna::lightmap
