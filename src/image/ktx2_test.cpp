#include "image/ktx2.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <initializer_list>
#include <string_view>

#include "core/random.hpp"
#include "core/test_folder.hpp"
#include "image/bc6h.hpp"
#include "image/rgb9e5.hpp"

namespace lucerna {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr HdrFormat kBoth[] = {HdrFormat::Rgb9e5, HdrFormat::Bc6h};

Image randomImage(int width, int height, int channels, std::uint64_t seed) {
  Random random(seed);
  Image image(width, height, channels, ComponentType::F32);
  for (float& value : image.as<float>()) value = std::exp2(random.uniform(-10.f, 10.f));
  return image;
}

bool same(const Image& a, const Image& b) {
  return a.width() == b.width() && a.height() == b.height() && a.channels() == b.channels() &&
         a.type() == b.type() && std::ranges::equal(a.bytes(), b.bytes());
}

void put(Bytes& bytes, std::initializer_list<int> values) {
  for (const int value : values) bytes.push_back(static_cast<std::byte>(value));
}
void put(Bytes& bytes, std::string_view text) {
  for (const char c : text) bytes.push_back(static_cast<std::byte>(c));
}

// Bytes 0 to 47, of a picture of 5x3 texels.
void putHeader(Bytes& bytes, int vkFormat, int typeSize, int layerCount) {
  put(bytes, {0xab, 'K', 'T', 'X', ' ', '2', '0', 0xbb, '\r', '\n', 0x1a, '\n'});
  put(bytes, {vkFormat, 0, 0, 0, typeSize, 0, 0, 0});
  put(bytes, {5, 0, 0, 0, 3, 0, 0, 0, 0, 0, 0, 0});  // width, height, depth
  put(bytes, {layerCount, 0, 0, 0, 1, 0, 0, 0});     // and faces
  put(bytes, {1, 0, 0, 0, 0, 0, 0, 0});              // levels, supercompression
}

void putPairs(Bytes& bytes) {
  put(bytes, {18, 0, 0, 0});
  put(bytes, std::string_view("KTXorientation\0rd\0\0\0", 20));
  put(bytes, {18, 0, 0, 0});
  put(bytes, std::string_view("KTXwriter\0Lucerna\0\0\0", 20));
}

Bytes firstOf(const Bytes& bytes, std::size_t count) {
  return {bytes.begin(),
          bytes.begin() + static_cast<std::ptrdiff_t>(std::min(count, bytes.size()))};
}

TEST(Ktx2Encode, WritesTheHeaderOfTheSpecificationForRgb9e5) {
  Bytes wanted;
  putHeader(wanted, 123, 4, 0);
  put(wanted, {104, 0, 0, 0, 124, 0, 0, 0});  // data format descriptor
  put(wanted, {228, 0, 0, 0, 48, 0, 0, 0});   // keys and values
  put(wanted, {0, 0, 0, 0, 0, 0, 0, 0});      // global data
  put(wanted, {0, 0, 0, 0, 0, 0, 0, 0});
  put(wanted, {20, 1, 0, 0, 0, 0, 0, 0});  // the level begins at 276
  put(wanted, {60, 0, 0, 0, 0, 0, 0, 0});
  put(wanted, {60, 0, 0, 0, 0, 0, 0, 0});
  put(wanted, {124, 0, 0, 0, 0, 0, 0, 0, 2, 0, 120, 0});  // sizes; version 1.3
  put(wanted, {1, 1, 1, 0});                              // RGBSDA, BT.709, linear, straight alpha
  put(wanted, {0, 0, 0, 0, 4, 0, 0, 0, 0, 0, 0, 0});      // blocks of a texel and 4 bytes
  for (int c = 0; c < 3; ++c) {
    put(wanted, {9 * c, 0, 8, c, 0, 0, 0, 0});      // 9 bits of mantissa
    put(wanted, {0, 0, 0, 0, 0, 33, 0, 0});         // from 0 to 8448
    put(wanted, {27, 0, 4, 0x20 + c, 0, 0, 0, 0});  // 5 bits of exponent
    put(wanted, {15, 0, 0, 0, 31, 0, 0, 0});        // its bias, the largest
  }
  putPairs(wanted);
  ASSERT_EQ(wanted.size(), 276u);
  const Image image = randomImage(5, 3, 3, 1);
  const Bytes bytes = encodeKtx2({&image, 1}, HdrFormat::Rgb9e5);
  EXPECT_EQ(firstOf(bytes, 276), wanted);
  ASSERT_EQ(bytes.size(), 276u + 60u);
  for (std::size_t i = 0; i < 15; ++i) {
    const float* color = image.as<float>().data() + 3 * i;
    const std::uint32_t bits = toRgb9e5({color[0], color[1], color[2]});
    for (std::size_t b = 0; b < 4; ++b)
      ASSERT_EQ(bytes[276 + 4 * i + b], static_cast<std::byte>(bits >> 8 * b)) << i;
  }
}

TEST(Ktx2Encode, WritesTheHeaderOfTheSpecificationForBc6h) {
  Bytes wanted;
  putHeader(wanted, 143, 1, 2);
  put(wanted, {104, 0, 0, 0, 44, 0, 0, 0});  // data format descriptor
  put(wanted, {148, 0, 0, 0, 48, 0, 0, 0});  // keys and values
  put(wanted, {0, 0, 0, 0, 0, 0, 0, 0});     // global data
  put(wanted, {0, 0, 0, 0, 0, 0, 0, 0});
  put(wanted, {208, 0, 0, 0, 0, 0, 0, 0});  // the level begins at a multiple of 16
  put(wanted, {64, 0, 0, 0, 0, 0, 0, 0});
  put(wanted, {64, 0, 0, 0, 0, 0, 0, 0});
  put(wanted, {44, 0, 0, 0, 0, 0, 0, 0, 2, 0, 40, 0});  // sizes; version 1.3
  put(wanted, {133, 1, 1, 0});                          // BC6H, BT.709, linear, straight alpha
  put(wanted, {3, 3, 0, 0, 16, 0, 0, 0, 0, 0, 0, 0});   // blocks of 4x4 texels and 16 bytes
  put(wanted, {0, 0, 127, 0x80, 0, 0, 0, 0});           // 128 bits that stand for floats
  put(wanted, {0, 0, 0, 0, 0, 0, 0x80, 0x3f});          // from 0 to 1
  putPairs(wanted);
  wanted.resize(208);
  const Image images[] = {randomImage(5, 3, 3, 1), randomImage(5, 3, 3, 2)};
  const Bytes bytes = encodeKtx2(images, HdrFormat::Bc6h);
  EXPECT_EQ(firstOf(bytes, 208), wanted);
  Bytes blocks = encodeBc6h(images[0]);
  const Bytes second = encodeBc6h(images[1]);
  blocks.insert(blocks.end(), second.begin(), second.end());
  EXPECT_EQ(Bytes(bytes.begin() + 208, bytes.end()), blocks);
}

TEST(Ktx2, GivesItsLayersBack) {
  const std::vector<Image> images = {randomImage(37, 22, 4, 3), randomImage(37, 22, 4, 4),
                                     randomImage(37, 22, 4, 5)};
  for (const HdrFormat format : kBoth) {
    const Bytes bytes = encodeKtx2(images, format);
    const auto texture = parseKtx2(bytes, "a.ktx2");
    ASSERT_TRUE(texture) << texture.error().message;
    EXPECT_EQ(texture->format, format);
    EXPECT_EQ(texture->layers, 3);
    const auto layers = decodeKtx2(bytes, "a.ktx2");
    ASSERT_TRUE(layers) << layers.error().message;
    ASSERT_EQ(layers->size(), 3u);
    for (int i = 0; i < 3; ++i) {
      const Image& found = (*layers)[i];
      if (format == HdrFormat::Bc6h) {
        EXPECT_TRUE(same(found, decodeBc6h(encodeBc6h(images[i]), 37, 22)));
        EXPECT_TRUE(std::ranges::equal(texture->layer(i), encodeBc6h(images[i])));
        continue;
      }
      for (int y = 0; y < 22; ++y)
        for (int x = 0; x < 37; ++x) {
          const float *a = images[i].pixel<float>(x, y), *b = found.pixel<float>(x, y);
          for (int c = 0; c < 3; ++c)
            ASSERT_LE(std::abs(a[c] - b[c]), std::max({a[0], a[1], a[2]}) / 512) << x << ' ' << y;
        }
    }
  }
}

TEST(Ktx2, TakesHalvesAsFloats) {
  const Image half = converted(randomImage(9, 9, 4, 6), ComponentType::Half, 4);
  const Image floats = converted(half, ComponentType::F32, 3);
  for (const HdrFormat format : kBoth)
    EXPECT_EQ(encodeKtx2({&half, 1}, format), encodeKtx2({&floats, 1}, format));
}

TEST(Ktx2, IsAnImageFileIfItHasOneLayer) {
  TestFolder folder;
  const Image images[] = {randomImage(6, 5, 3, 7), randomImage(6, 5, 3, 8)};
  for (const HdrFormat format : kBoth) {
    ASSERT_TRUE(writeKtx2(folder / "a.ktx2", {images, 1}, format));
    const Bytes bytes = *readFile(folder / "a.ktx2");
    const auto image = readImage(folder / "a.ktx2");
    ASSERT_TRUE(image) << image.error().message;
    EXPECT_TRUE(same(*image, readKtx2(folder / "a.ktx2").value()[0]));
    const auto info = imageInfo(bytes, "unnamed");
    ASSERT_TRUE(info) << info.error().message;
    EXPECT_EQ(info->format, "KTX2");
    EXPECT_EQ(info->bytes(), image->bytes().size());
    EXPECT_THAT(decodeImage(bytes, "a.ktx2", {.maxSide = 5}).error().message,
                HasSubstr("declares 6x5 pixels; at most 5 a side"));
    ASSERT_TRUE(writeKtx2(folder / "a.ktx2", images, format));
    EXPECT_THAT(readImage(folder / "a.ktx2").error().message,
                HasSubstr("2 layers, a picture has one"));
  }
}

TEST(Ktx2, KeepsItsLimits) {
  const Image images[] = {randomImage(6, 5, 3, 7), randomImage(6, 5, 3, 8)};
  for (const HdrFormat format : kBoth) {
    const Bytes bytes = encodeKtx2(images, format);
    EXPECT_TRUE(decodeKtx2(bytes, "a.ktx2", {.maxSide = 6, .maxBytes = 720}));
    EXPECT_THAT(decodeKtx2(bytes, "a.ktx2", {.maxSide = 5}).error().message,
                HasSubstr("declares 6x5 texels; at most 5 a side"));
    EXPECT_THAT(decodeKtx2(bytes, "a.ktx2", {.maxBytes = 719}).error().message,
                HasSubstr("2 layers of 6x5 texels, which take 720 B once decoded; at most 719 B"));
  }
}

// Of 5x3 and 2x1 texels, the smaller one first. The second entry of the level index moves what
// follows by 24 bytes.
TEST(Ktx2, ReadsTheLargestOfSeveralLevels) {
  const Image image = randomImage(5, 3, 3, 9), small = randomImage(2, 1, 3, 10);
  const Bytes large = encodeKtx2({&image, 1}, HdrFormat::Rgb9e5),
              other = encodeKtx2({&small, 1}, HdrFormat::Rgb9e5);
  Bytes bytes = firstOf(large, 104);
  bytes[40] = std::byte{2};
  bytes[48] = std::byte{104 + 24};
  bytes[56] = std::byte{228 + 24};
  bytes[80] = std::byte{276 + 24 + 8 - 256};
  put(bytes, {276 + 24 - 256, 1, 0, 0, 0, 0, 0, 0, 8, 0, 0, 0, 0, 0, 0, 0, 8, 0, 0, 0, 0, 0, 0, 0});
  bytes.insert(bytes.end(), large.begin() + 104, large.begin() + 276);
  bytes.insert(bytes.end(), other.begin() + 276, other.end());
  bytes.insert(bytes.end(), large.begin() + 276, large.end());
  const auto layers = decodeKtx2(bytes, "a.ktx2");
  ASSERT_TRUE(layers) << layers.error().message;
  EXPECT_TRUE(same((*layers)[0], decodeKtx2(large, "a.ktx2").value()[0]));
  bytes[104 + 8] = std::byte{12};
  EXPECT_THAT(decodeKtx2(bytes, "a.ktx2").error().message,
              HasSubstr("level 1 of 1 layers of 2x1 texels takes 12 bytes"));
}

Bytes with(Bytes bytes, std::size_t at, int value) {
  bytes[at] = static_cast<std::byte>(value);
  return bytes;
}
std::string faultOf(const Bytes& bytes) {
  const auto layers = decodeKtx2(bytes, "a.ktx2");
  return layers ? "none" : layers.error().message;
}

TEST(Ktx2Parse, NamesWhatItDoesNotRead) {
  const Image image = randomImage(8, 8, 3, 11);
  const Bytes bytes = encodeKtx2({&image, 1}, HdrFormat::Bc6h);
  EXPECT_THAT(faultOf(with(bytes, 12, 144)), HasSubstr("a.ktx2: KTX2 of VkFormat 144; E5B9G9R9"));
  EXPECT_THAT(faultOf(with(bytes, 44, 2)), HasSubstr("supercompression scheme 2; none (0)"));
  EXPECT_THAT(faultOf(with(bytes, 28, 1)), HasSubstr("depth 1 and 1 faces"));
  EXPECT_THAT(faultOf(with(bytes, 36, 6)), HasSubstr("depth 0 and 6 faces"));
  EXPECT_THAT(faultOf(with(bytes, 16, 2)), HasSubstr("a type size of 2, 1 was wanted"));
  EXPECT_THAT(faultOf(with(bytes, 20, 0)), HasSubstr("a size of zero"));
  EXPECT_THAT(faultOf(with(bytes, 23, 0x80)), HasSubstr("2^31 texels"));
  EXPECT_THAT(faultOf(with(bytes, 40, 0)), HasSubstr("0 levels for 8x8 texels"));
  EXPECT_THAT(faultOf(with(bytes, 40, 5)), HasSubstr("5 levels for 8x8 texels"));
  EXPECT_THAT(faultOf(with(bytes, 104 + 12, 134)), HasSubstr("contradicts its VkFormat"));
  EXPECT_THAT(faultOf(with(bytes, 104 + 14, 2)), HasSubstr("transfer function 2; linear light"));
  EXPECT_THAT(faultOf(with(bytes, 24, 9)), HasSubstr("level 0 of 1 layers of 8x9 texels takes 64"));
  EXPECT_THAT(faultOf(with(bytes, 80, 224)), HasSubstr("truncated or corrupt"));
  EXPECT_THAT(faultOf(with(bytes, 148 + 4 + 16, 'u')), HasSubstr("KTXorientation is not 'rd'"));
  EXPECT_EQ(faultOf(with(bytes, 104 + 13, 0)), "none") << "other primary colours";
  EXPECT_EQ(faultOf(with(bytes, 32, 1)), "none") << "an array of one";
}

TEST(Ktx2Parse, NamesWhatItDoesNotReadOfOthersFiles) {
  const fs::path path = fs::path(LUCERNA_SOURCE_DIR) /
                        "../shared/scenes/bevy_cornell_lightmap/CornellBox-Box.zstd.ktx2";
  if (!fs::exists(path)) GTEST_SKIP() << path << " is missing";
  EXPECT_THAT(readKtx2(path).error().message, HasSubstr("KTX2 of VkFormat 122"));
}

TEST(Ktx2Parse, EveryTruncationIsRefused) {
  const Image image = randomImage(13, 6, 3, 12);
  for (const HdrFormat format : kBoth) {
    const Bytes bytes = encodeKtx2({&image, 1}, format);
    for (std::size_t size = 0; size < bytes.size(); ++size) {
      const auto layers = decodeKtx2(std::span(bytes).first(size), "a.ktx2");
      ASSERT_FALSE(layers) << size << " of " << bytes.size();
      ASSERT_EQ(layers.error().kind, ErrorKind::Input);
      ASSERT_THAT(layers.error().message, HasSubstr("a.ktx2"));
    }
  }
}

// Another value of a header's byte is an error or makes no difference: but for a side that needs as
// many blocks.
TEST(Ktx2Parse, EveryOtherHeaderIsRefusedOrSaysTheSame) {
  const Image image = randomImage(13, 6, 3, 13);
  for (const HdrFormat format : kBoth) {
    const Bytes bytes = encodeKtx2({&image, 1}, format);
    const Image wanted = decodeKtx2(bytes, "a.ktx2").value()[0];
    const std::size_t header = bytes.size() - parseKtx2(bytes, "a.ktx2")->texels.size();
    int refused = 0;
    for (std::size_t at = 0; at < header; ++at)
      for (int change = 1; change < 256; ++change) {
        const auto layers =
            decodeKtx2(with(bytes, at, std::to_integer<int>(bytes[at]) ^ change), "a.ktx2");
        if (!layers) {
          ++refused;
          ASSERT_THAT(layers.error().message, HasSubstr("a.ktx2"));
        } else if (at < 20 || at >= 28) {
          ASSERT_EQ(layers->size(), 1u) << at;
          ASSERT_TRUE(same((*layers)[0], wanted)) << at << " changed by " << change;
        }
      }
    EXPECT_GT(refused, static_cast<int>(header) * 255 / 2);
  }
}

TEST(Ktx2Parse, RandomDamageNeverDoesHarm) {
  const Image images[] = {randomImage(13, 6, 3, 14), randomImage(13, 6, 3, 15)};
  const ImageLimits limits{.maxBytes = 4 << 20};
  Random random(16);
  for (const HdrFormat format : kBoth) {
    const Bytes bytes = encodeKtx2(images, format);
    for (int round = 0; round < 20000; ++round) {
      Bytes damaged = bytes;
      for (std::uint32_t i = 0; i <= random.below(4); ++i)
        damaged[random.below(round % 2 == 0 ? 104 : static_cast<std::uint32_t>(damaged.size()))] =
            static_cast<std::byte>(random.next());
      const auto layers = decodeKtx2(damaged, "a.ktx2", limits);
      if (!layers) continue;
      for (const Image& layer : *layers)
        for (const float value : layer.as<float>()) ASSERT_TRUE(std::isfinite(value));
    }
  }
}

}  // namespace
}  // namespace lucerna
