// Partly blocked lights of tiles against what the mask's pixels say.
#include "passes/shadow_tiles/shadow_tiles.hpp"

#include <gtest/gtest.h>

#include <cstring>

#include "core/random.hpp"
#include "support/testing.hpp"

namespace lucerna {
namespace {

constexpr ivec2 kSize{150, 70};  // the last tiles are cut off
constexpr ivec2 kTiles{10, 5};
constexpr int kLights = 40;

// Rectangles of blocked layers, and a part of the picture where nothing was drawn.
struct Picture {
  Image mask{kSize.x, kSize.y, 1, ComponentType::F32};  // bits
  Image depth{kSize.x, kSize.y, 1, ComponentType::F32};
};
Picture randomPicture(Random& random) {
  Picture picture;
  std::ranges::fill(picture.mask.as<std::uint32_t>(), 0u);
  std::ranges::fill(picture.depth.as<float>(), 0.5f);
  for (int layer = 0; layer < 32; ++layer) {
    const ivec2 from(random.uniform(-40.f, 140.f), random.uniform(-40.f, 60.f));
    const ivec2 to = from + ivec2(random.uniform(1.f, 120.f), random.uniform(1.f, 120.f));
    for (int y = std::max(from.y, 0); y < std::min(to.y, kSize.y); ++y)
      for (int x = std::max(from.x, 0); x < std::min(to.x, kSize.x); ++x)
        *picture.mask.pixel<std::uint32_t>(x, y) |= 1u << layer;
  }
  for (int y = 20; y < kSize.y; ++y)
    for (int x = 70; x < 100; ++x) *picture.depth.pixel<float>(x, y) = 0.f;
  return picture;
}

gpu::Buffer bufferOf(std::span<const std::uint32_t> words) {
  return testing::device().createBuffer(std::as_bytes(words), "words");
}

// Layers that are blocked at some pixel that was drawn of tiles near one, and not at another.
std::uint32_t partlyBlocked(const Picture& picture, ivec2 tile, int reach) {
  const ivec2 from = glm::max(tile - reach, ivec2(0)) * render::kLightTile;
  const ivec2 to = glm::min((tile + reach + 1) * render::kLightTile, kSize);
  std::uint32_t blocked = 0, lit = 0;
  for (int y = from.y; y < to.y; ++y)
    for (int x = from.x; x < to.x; ++x) {
      if (picture.depth.pixel<float>(x, y)[0] == 0.f) continue;
      blocked |= *picture.mask.pixel<std::uint32_t>(x, y);
      lit |= ~*picture.mask.pixel<std::uint32_t>(x, y);
    }
  return blocked & lit;
}

struct Inputs {
  const render::LightList& lights;
  const render::TileLights& tiles;
  const render::ShadowLayers& layers;
  const gpu::Texture &mask, &depth;
  const render::ShadowValues* values = nullptr;
};

// The words of partlyLit.
std::vector<std::uint32_t> found(const Inputs& inputs, int reach) {
  render::TileLights partlyLit;
  passes::ShadowTiles::Ports ports;
  ports.lights.bind(&inputs.lights);
  ports.tileLights.bind(&inputs.tiles);
  ports.shadowLayers.bind(&inputs.layers);
  ports.shadowMask.bind(&inputs.mask);
  if (inputs.values) ports.shadowValues.bind(inputs.values);
  ports.depth.bind(&inputs.depth);
  ports.partlyLit.bind(&partlyLit);
  graph::PassContext context{.device = testing::device()};
  passes::ShadowTiles(testing::device()).execute(context, {.reach = reach}, ports);
  EXPECT_EQ(partlyLit.tiles, inputs.tiles.tiles);
  const std::vector<std::byte> bytes = testing::device().download(partlyLit.block);
  std::vector<std::uint32_t> words(bytes.size() / 4);
  std::memcpy(words.data(), bytes.data(), words.size() * 4);
  return words;
}

TEST(ShadowTiles, NameTheLightsThatAreBlockedInPart) {
  Random random(2);
  const Picture picture = randomPicture(random);
  const gpu::Texture mask = testing::uploaded(picture.mask, gpu::Format::R32Uint);
  const gpu::Texture depth = testing::uploaded(picture.depth, gpu::Format::Depth32F);

  render::LightList lights;
  std::vector<std::uint32_t> lightWords(8 + 20 * kLights);
  lightWords[4] = kLights;  // of LightHeader
  lights.block = bufferOf(lightWords);
  render::ShadowLayers layers;
  std::vector<std::uint32_t> layerWords(kLights);
  for (std::uint32_t& layer : layerWords) layer = random.below(33) - 1;  // -1: none
  layers.block = bufferOf(layerWords);
  render::TileLights tiles{.tiles = kTiles.x * kTiles.y, .block = {}};
  std::vector<std::uint32_t> tileWords(4 + 2 * tiles.tiles);
  tileWords[0] = kTiles.x, tileWords[1] = 2;
  for (std::size_t i = 4; i < tileWords.size(); ++i)
    tileWords[i] = random.below(0xffffffff) & (i % 2 == 0 ? ~0u : (1u << (kLights - 32)) - 1u);
  tiles.block = bufferOf(tileWords);

  for (const int reach : {0, 1, 48}) {
    SCOPED_TRACE(reach);
    const auto words = found({lights, tiles, layers, mask, depth}, reach);
    EXPECT_TRUE(std::equal(words.begin(), words.begin() + 4, tileWords.begin()));
    int named = 0, there = 0;
    for (std::uint32_t tile = 0; tile < tiles.tiles; ++tile) {
      // Rows of the picture go up, as those of tiles do.
      const ivec2 at(tile % kTiles.x, tile / kTiles.x);
      const std::uint32_t partly = partlyBlocked(picture, at, (reach + 15) / 16);
      for (std::uint32_t light = 0; light < kLights; ++light) {
        const std::size_t word = 4 + 2 * tile + light / 32;
        const int layer = static_cast<int>(layerWords[light]);
        const bool has = (tileWords[word] >> light % 32 & 1u) != 0;
        const bool wanted = has && layer >= 0 && (partly >> layer & 1u) != 0;
        ASSERT_EQ(words[word] >> light % 32 & 1u, wanted ? 1u : 0u) << tile << " " << light;
        named += wanted, there += has;
      }
    }
    EXPECT_GT(named, there / 20);
    EXPECT_LT(named, there);
  }
  testing::expectNoDebugMessages();
}

// Bytes of layers in place of bits: what is dark in part everywhere is neither all lit nor all
// dark.
TEST(ShadowTiles, NameTheLightsWhoseValuesAreBetween) {
  Image depthImage(16, 16, 1, ComponentType::F32);
  std::ranges::fill(depthImage.as<float>(), 0.5f);
  const gpu::Texture depth = testing::uploaded(depthImage, gpu::Format::Depth32F);
  render::LightList lights;
  std::vector<std::uint32_t> lightWords(8 + 20 * 4);
  lightWords[4] = 4;  // of LightHeader
  lights.block = bufferOf(lightWords);
  render::ShadowLayers layers;
  layers.block = bufferOf(std::vector<std::uint32_t>{0, 1, 2, 3});
  render::TileLights tiles{.tiles = 1,
                           .block = bufferOf(std::vector<std::uint32_t>{1, 1, 0, 0, 15})};
  Image bytes(16, 16, 1, ComponentType::F32);
  std::ranges::fill(bytes.as<std::uint32_t>(), 0x00c8ffffu);  // layers: lit, lit, between, dark
  bytes.as<std::uint32_t>()[7] = 0x00c8feffu;  // and the second hardly dark at one pixel
  render::ShadowValues values;
  values.layers = 4;
  values.bytes = testing::device().createTexture({.kind = gpu::TextureKind::Array2D,
                                                  .format = gpu::Format::R32Uint,
                                                  .width = 16,
                                                  .height = 16,
                                                  .layers = 1},
                                                 "values");
  testing::device().upload(values.bytes, bytes);
  Image none(16, 16, 1, ComponentType::F32);
  std::ranges::fill(none.as<std::uint32_t>(), 8u);  // the mask of those values
  const gpu::Texture mask = testing::uploaded(none, gpu::Format::R32Uint);
  for (const bool byValues : {false, true}) {
    const auto words = found({lights, tiles, layers, mask, depth, byValues ? &values : nullptr}, 0);
    EXPECT_EQ(words[4], byValues ? 6u : 0u);
  }
  testing::expectNoDebugMessages();
}

}  // namespace
}  // namespace lucerna
