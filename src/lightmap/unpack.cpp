#include "lightmap/unpack.hpp"

#include <algorithm>

#include "lightmap/patch_triangle.hpp"

namespace lucerna::lightmap {
namespace {

// Walks the trees of a patch, leaf by leaf.
class Leaves {
 public:
  Leaves(const Patch& patch, bool skirt, TexelTiles& texels)
      : patch_(patch), skirt_(skirt), texels_(texels) {}

  void drawAll() {
    for (const PatchRoot& root : patch_.triangles.roots) draw(root, triangleOf(root));
  }

 private:
  void draw(const PatchRoot& root, const PatchTriangle& triangle) {
    const PatchNode node = patch_.triangles.nodes[node_++];
    if (node == PatchNode::Split)
      for (int part = 0; part < 4; ++part) draw(root, partOf(triangle, part));
    if (node == PatchNode::Leaf) drawLeaf(root, triangle);
  }

  void drawLeaf(const PatchRoot& root, const PatchTriangle& triangle) {
    std::array<vec3, 3> values{};  // of each channel, at the corners
    for (std::size_t c = 0; c < patch_.channels; ++c)
      for (int i = 0; i < 3; ++i)
        values[c][i] = root.scale * static_cast<float>(patch_.triangles.values[value_++]);
    if (skirt_ && triangle.borders == 0) return;
    TriangleTexels(triangle, skirt_, patch_.side).forEach([&](int x, int y, vec3 weights) {
      vec3 light(0.f);
      for (int c = 0; c < patch_.channels; ++c)
        light[c] = glm::dot(weights, values[static_cast<std::size_t>(c)]);
      if (std::max({light.x, light.y, light.z}) <= patch_.least) return;
      if (texels_.find(root.map, x, y)) return;
      float* texel = texels_.add(root.map, x, y);
      for (int c = 0; c < patch_.channels; ++c) texel[c * kTileTexels] = light[c];
    });
  }

  const Patch& patch_;
  bool skirt_;
  TexelTiles& texels_;
  std::size_t node_ = 0, value_ = 0;
};

void replaceBy(const LightTile& tile, std::span<const std::uint16_t> values, TexelTiles& texels) {
  forTexels(tile.place, tile.mask, [&](int x, int y, int bit) {
    float* texel = texels.add(tile.place.map, x, y);
    for (std::size_t c = 0; c < texels.channels(); ++c)
      texel[c * kTileTexels] =
          tile.scale * static_cast<float>(values[c * kTileTexels + static_cast<std::size_t>(bit)]);
  });
}

void replaceBy(const TileLight& light, TexelTiles& texels) {
  const std::size_t perTile = texels.channels() * kTileTexels;
  for (std::size_t i = 0; i < light.tiles.size(); ++i)
    replaceBy(light.tiles[i], std::span(light.values).subspan(i * perTile, perTile), texels);
}

}  // namespace

TexelTiles lightOfTriangles(const Patch& patch) {
  TexelTiles texels(patch.channels);
  for (const bool skirt : {false, true}) Leaves(patch, skirt, texels).drawAll();
  return texels;
}

TexelTiles decoded(const TileLight& light, std::size_t channels) {
  TexelTiles texels(channels);
  replaceBy(light, texels);
  return texels;
}

TileLight unpacked(const Patch& patch) {
  if (patch.triangles.roots.empty()) return patch.tiles;
  TexelTiles texels = lightOfTriangles(patch);
  replaceBy(patch.tiles, texels);
  return encoded(texels);
}

}  // namespace lucerna::lightmap
