#include "lightmap/patch.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numeric>

#include "core/random.hpp"
#include "lightmap/patch_triangle.hpp"
#include "lightmap/unpack.hpp"

namespace lucerna::lightmap {
namespace {

// A square of two triangles, the first split once with one part left out, and a tile over them.
Patch squarePatch() {
  Patch patch{.group = "lamps", .color = vec3(2, 1, 0.5f), .side = 32, .maps = 2};
  const int u = kPatchUnit;
  patch.triangles.roots = {{.map = 1,
                            .borders = 5,
                            .scale = 0.5f,
                            .corners = {ivec2(0), ivec2(16 * u, 0), ivec2(16 * u)}},
                           {.map = 1,
                            .borders = 3,
                            .scale = 2.f,
                            .corners = {ivec2(0), ivec2(16 * u), ivec2(0, 16 * u)}}};
  using enum PatchNode;
  patch.triangles.nodes = {Split, Leaf, Nothing, Leaf, Leaf, Leaf};
  patch.triangles.values.resize(12);
  std::iota(patch.triangles.values.begin(), patch.triangles.values.end(), std::uint16_t{100});
  patch.tiles.tiles = {{.place = {1, 0, 1}, .scale = 3.f, .mask = 0b1001}};
  patch.tiles.values.resize(kTileTexels);
  patch.tiles.values[0] = 7;
  return patch;
}

Bytes bytesOf(const TileLight& light) {
  return toBytes({.side = 32, .maps = 2, .tiles = light});
}

TEST(Patch, BytesAndBack) {
  const Patch patch = squarePatch();
  const Result<Patch> back = patchFrom(toBytes(patch), "patch.bin");
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_EQ(back->group, "lamps");
  EXPECT_EQ(back->color, vec3(2, 1, 0.5f));
  EXPECT_EQ(back->form(), "triangles");
  EXPECT_EQ(back->triangles.nodes, patch.triangles.nodes);
  EXPECT_EQ(back->triangles.values, patch.triangles.values);
  EXPECT_EQ(back->triangles.roots[1].corners, patch.triangles.roots[1].corners);
  EXPECT_EQ(back->tiles.tiles[0].mask, 0b1001u);
  EXPECT_EQ(back->tiles.values, patch.tiles.values);
  EXPECT_EQ(bytesOf(unpacked(*back)), bytesOf(unpacked(patch)));
}

TEST(Patch, AnEmptyOneIsAPatch) {
  const Result<Patch> back = patchFrom(toBytes({.group = "none", .side = 8, .maps = 1}), "p");
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_EQ(back->form(), "tiles");
  EXPECT_TRUE(unpacked(*back).tiles.empty());
}

TEST(Patch, SaysWhatIsWrong) {
  const Result<Patch> none = patchFrom({}, "patch-000.bin");
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().kind, ErrorKind::Input);
  EXPECT_EQ(none.error().message, "patch-000.bin: found no light patch; bake the scene again");
}

TEST(Patch, EveryMissingByteIsFound) {
  const Bytes bytes = toBytes(squarePatch());
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_FALSE(patchFrom(std::span(bytes).first(size), "patch.bin")) << size;
  Bytes longer = bytes;
  longer.push_back(std::byte{0});
  EXPECT_FALSE(patchFrom(longer, "patch.bin"));
}

TEST(Patch, NoFlippedByteLeadsOutside) {
  const Bytes bytes = toBytes(squarePatch());
  int read = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i)
    for (int bit = 0; bit < 8; ++bit) {
      Bytes flipped = bytes;
      flipped[i] ^= std::byte{1} << bit;
      const Result<Patch> patch = patchFrom(flipped, "patch.bin");
      if (!patch) continue;
      ++read;
      const TileLight light = unpacked(*patch);
      ASSERT_EQ(light.values.size(), light.tiles.size() * patch->channels * kTileTexels);
      for (const LightTile& tile : light.tiles) {
        ASSERT_LT(tile.place.map, patch->maps);
        ASSERT_LT(tile.place.x * kTileSide, patch->side);
        ASSERT_LT(tile.place.y * kTileSide, patch->side);
      }
    }
  EXPECT_GT(read, 100);  // colours, scales, values
}

TEST(Patch, RefusesWhatDoesNotBelong) {
  const auto refused = [](auto change) {
    Patch patch = squarePatch();
    change(patch);
    return !patchFrom(toBytes(patch), "patch.bin");
  };
  EXPECT_FALSE(refused([](Patch&) {}));
  EXPECT_TRUE(refused([](Patch& p) { p.side = 0; }));
  EXPECT_TRUE(refused([](Patch& p) { p.maps = 1; }));
  EXPECT_TRUE(refused([](Patch& p) { p.color.x = -1.f; }));
  EXPECT_TRUE(refused([](Patch& p) { p.color.y = std::nanf(""); }));
  EXPECT_TRUE(refused([](Patch& p) { p.triangles.roots[0].corners[1].x = 33 * kPatchUnit; }));
  EXPECT_TRUE(refused([](Patch& p) { p.triangles.roots[0].scale = -1.f; }));
  EXPECT_TRUE(refused([](Patch& p) { p.triangles.roots.pop_back(); }));
  EXPECT_TRUE(refused([](Patch& p) { p.triangles.nodes.pop_back(); }));
  EXPECT_TRUE(refused([](Patch& p) { p.triangles.nodes.push_back(PatchNode::Leaf); }));
  EXPECT_TRUE(refused([](Patch& p) { p.triangles.nodes[1] = PatchNode::Nothing; }));
  EXPECT_TRUE(refused([](Patch& p) { p.triangles.values.push_back(0); }));
  EXPECT_TRUE(refused([](Patch& p) { p.tiles.tiles[0].place.y = 4; }));
  EXPECT_TRUE(refused([](Patch& p) { p.tiles.tiles[0].mask = 0; }));
  EXPECT_TRUE(refused([](Patch& p) { p.tiles.tiles[0].scale = INFINITY; }));
  // Of a map that ends in the middle of a tile.
  EXPECT_TRUE(refused([](Patch& p) {
    p.triangles = {};
    p.side = 11;
    p.tiles.tiles[0].mask = 1u << 24;  // row 3 of a tile that has rows 0 to 2
  }));
  // A place twice.
  EXPECT_TRUE(refused([](Patch& p) {
    p.tiles.tiles.push_back(p.tiles.tiles[0]);
    p.tiles.values.resize(2 * kTileTexels);
  }));
}

// Independent of the rows: each texel asked by itself, in doubles that hold these numbers exactly.
std::map<std::pair<int, int>, vec3> texelsByHand(const PatchTriangle& t, int side) {
  std::map<std::pair<int, int>, vec3> texels;
  const auto twiceArea = [](glm::dvec2 a, glm::dvec2 b, glm::dvec2 c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  };
  std::array<glm::dvec2, 3> p;
  for (std::size_t i = 0; i < 3; ++i)
    p[i] = glm::dvec2(t.corners[i]) / static_cast<double>(PatchTriangle::kUnit);
  const double all = twiceArea(p[0], p[1], p[2]);
  if (all == 0.) return texels;
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const glm::dvec2 m(x + 0.5, y + 0.5);
      const glm::dvec3 w(twiceArea(p[1], p[2], m) / all, twiceArea(p[2], p[0], m) / all,
                         twiceArea(p[0], p[1], m) / all);
      if (w.x >= 0. && w.y >= 0. && w.z >= 0.) texels[{x, y}] = vec3(w);
    }
  return texels;
}

TEST(PatchTriangle, HasTheTexelsWhoseMiddleItHolds) {
  Random random(5);
  constexpr int kSide = 24;
  const auto corner = [&] {
    // Some on the middles of texels and on their corners, so that edges hit them exactly.
    const auto at = [&] { return static_cast<int>(random.below(kSide * 2 + 1)) * kPatchUnit / 2; };
    return random.below(2) == 0
               ? ivec2(at(), at())
               : ivec2(random.below(kSide * kPatchUnit + 1), random.below(kSide * kPatchUnit + 1));
  };
  std::size_t found = 0;
  for (int i = 0; i < 2000; ++i) {
    PatchTriangle t = triangleOf({.corners = {corner(), corner(), corner()}});
    for (int split = static_cast<int>(random.below(4)); split > 0; --split)
      t = partOf(t, static_cast<int>(random.below(4)));
    auto wanted = texelsByHand(t, kSide);
    TriangleTexels(t, false, kSide).forEach([&](int x, int y, vec3 weights) {
      const auto it = wanted.find({x, y});
      ASSERT_NE(it, wanted.end()) << x << ' ' << y;
      for (int c = 0; c < 3; ++c) ASSERT_NEAR(weights[c], it->second[c], 1e-6f);
      wanted.erase(it);
      ++found;
    });
    ASSERT_TRUE(wanted.empty()) << i;
  }
  EXPECT_GT(found, 10000u);
}

TEST(PatchTriangle, FourPartsAreTheWhole) {
  const PatchTriangle whole =
      triangleOf({.borders = 7, .corners = {ivec2(3, 5), ivec2(300, 77), ivec2(121, 341)}});
  std::map<std::pair<int, int>, int> count;
  TriangleTexels(whole, false, 24).forEach([&](int x, int y, vec3) { ++count[{x, y}]; });
  const std::size_t all = count.size();
  for (int part = 0; part < 4; ++part) {
    EXPECT_EQ(partOf(whole, part).borders, part == 3 ? 0u : 7u & ~(1u << part));
    TriangleTexels(partOf(whole, part), false, 24).forEach([&](int x, int y, vec3) {
      ++count[{x, y}];
    });
  }
  EXPECT_GT(all, 100u);
  EXPECT_EQ(count.size(), all);
  for (const auto& [texel, times] : count) EXPECT_GE(times, 2);  // a texel on a seam is in two
}

TEST(PatchTriangle, ASkirtReachesTwoTexelsAcrossBordersOnly) {
  // Right of x = 8 it ends, below its diagonal it goes on.
  const int u = kPatchUnit;
  const PatchTriangle t =
      triangleOf({.borders = 1, .corners = {ivec2(0), ivec2(8 * u, 0), ivec2(8 * u)}});
  std::map<std::pair<int, int>, vec3> texels;
  TriangleTexels(t, true, 24).forEach([&](int x, int y, vec3 w) { texels[{x, y}] = w; });
  EXPECT_TRUE(texels.contains({9, 4}));
  EXPECT_FALSE(texels.contains({10, 4}));
  EXPECT_FALSE(texels.contains({3, 4}));
  for (const auto& [texel, w] : texels) {
    EXPECT_TRUE(w.x >= 0.f && w.y >= 0.f && w.z >= 0.f);
    EXPECT_NEAR(w.x + w.y + w.z, 1.f, 1e-6f);
    if (texel.first > 7) {
      EXPECT_EQ(w.x, 0.f);  // as on the border
    }
  }
}

TEST(Unpacked, TilesReplaceTriangles) {
  Patch patch = squarePatch();
  const TileLight light = unpacked(patch);
  TexelTiles texels = decoded(light, 1);
  ASSERT_NE(texels.find(1, 0, 8), nullptr);
  EXPECT_NEAR(*texels.find(1, 0, 8), 21.f, 2e-3f);  // the tile's own
  EXPECT_EQ(*texels.find(1, 3, 8), 0.f);            // said to be dark
  EXPECT_GT(*texels.find(1, 2, 8), 0.f);            // the triangles'
  EXPECT_EQ(texels.find(0, 0, 8), nullptr);
}

TEST(TexelTiles, AreOffByHalfAStepOfTheirLargest) {
  Random random(11);
  TexelTiles texels(3);
  std::vector<float> wanted;
  for (int i = 0; i < 64; ++i)
    for (int c = 0; c < 3; ++c) {
      wanted.push_back(std::exp(random.uniform(-12.f, 3.f)));
      texels.add(4, 16 + i % 8, 80 + i / 8)[c * kTileTexels] = wanted.back();
    }
  const float step = *std::max_element(wanted.begin(), wanted.end()) / 65535.f;
  const TileLight light = encoded(texels);
  ASSERT_EQ(light.tiles.size(), 1u);
  EXPECT_EQ(light.tiles[0].place, (TilePlace{4, 2, 10}));
  for (std::size_t i = 0; i < 64; ++i)
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_NEAR(light.tiles[0].scale * light.values[c * 64 + i], wanted[i * 3 + c], 0.51f * step);
}

}  // namespace
}  // namespace lucerna::lightmap
