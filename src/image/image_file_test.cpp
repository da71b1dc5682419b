#include "image/image_file.hpp"

#include <gmock/gmock.h>
#include <sys/resource.h>
#include <turbojpeg.h>
#include <zlib.h>

#include <cmath>
#include <cstring>

#include "core/log.hpp"
#include "core/random.hpp"
#include "core/test_folder.hpp"

namespace lucerna {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

Image randomImage(int width, int height, int channels, ComponentType type, std::uint64_t seed = 1) {
  Random random(seed);
  Image image(width, height, channels, ComponentType::F32);
  for (float& value : image.as<float>()) value = random.uniform();
  return converted(image, type, channels);
}

bool same(const Image& a, const Image& b) {
  return a.width() == b.width() && a.height() == b.height() && a.channels() == b.channels() &&
         a.type() == b.type() && std::ranges::equal(a.bytes(), b.bytes());
}

class ImageFileTest : public testing::Test {
 protected:
  Bytes written(const std::string& name, const Image& image) {
    EXPECT_TRUE(writeImage(folder_ / name, image));
    return *readFile(folder_ / name);
  }
  TestFolder folder_;
};

void put(Bytes& bytes, std::initializer_list<int> values) {
  for (const int value : values) bytes.push_back(static_cast<std::byte>(value));
}

// An uncompressed TGA of 2x2 colour pixels (bottom row first), or run lengths.
Bytes tga(bool runLengths) {
  Bytes bytes;
  put(bytes, {0, 0, runLengths ? 10 : 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 2, 0, 2, 0, 24, 0});
  if (runLengths)
    put(bytes, {0x81, 1, 2, 3, 0x01, 4, 5, 6, 7, 8, 9});
  else
    put(bytes, {1, 2, 3, 1, 2, 3, 4, 5, 6, 7, 8, 9});
  return bytes;
}

// A BMP of 2x2 pixels in 24 bits.
Bytes bmp() {
  Bytes bytes;
  put(bytes, {'B', 'M', 70, 0, 0,  0, 0, 0, 0, 0, 54, 0, 0, 0, 40, 0, 0, 0, 2, 0, 0, 0, 2, 0,
              0,   0,   1,  0, 24, 0, 0, 0, 0, 0, 0,  0, 0, 0, 0,  0, 0, 0, 0, 0, 0, 0, 0, 0,
              0,   0,   0,  0, 0,  0, 1, 2, 3, 1, 2,  3, 0, 0, 4,  5, 6, 7, 8, 9, 0, 0});
  return bytes;
}

Bytes jpeg(const Image& image) {
  tjhandle encoder = tjInitCompress();
  unsigned char* out = nullptr;
  unsigned long size = 0;
  EXPECT_EQ(tjCompress2(encoder, image.as<std::uint8_t>().data(), image.width(), 0, image.height(),
                        image.channels() == 1 ? TJPF_GRAY : TJPF_RGB, &out, &size,
                        image.channels() == 1 ? TJSAMP_GRAY : TJSAMP_444, 95, 0),
            0);
  const auto* first = reinterpret_cast<const std::byte*>(out);
  Bytes bytes(first, first + size);
  tjFree(out);
  tjDestroy(encoder);
  return bytes;
}

TEST_F(ImageFileTest, PngKeepsEveryBit) {
  for (const auto type : {ComponentType::U8, ComponentType::U16})
    for (int channels = 1; channels <= 4; ++channels) {
      const Image image = randomImage(37, 19, channels, type);
      const Bytes bytes = written("a.png", image);
      const Result<Image> back = decodeImage(bytes, "a.png");
      ASSERT_TRUE(back) << back.error().message;
      EXPECT_TRUE(same(*back, image)) << channels;
      const Result<ImageInfo> info = imageInfo(bytes, "a.png");
      ASSERT_TRUE(info);
      EXPECT_EQ(info->format, "PNG");
      EXPECT_THAT((std::vector{info->width, info->height, info->channels}),
                  ElementsAre(37, 19, channels));
      EXPECT_EQ(info->bytes(), back->bytes().size());
    }
}

TEST_F(ImageFileTest, ExrKeepsEveryBitAndTheChannels) {
  for (int channels = 1; channels <= 4; ++channels) {
    const Image image = randomImage(37, 19, channels, ComponentType::F32);
    const Bytes bytes = written("a.exr", image);
    const Result<Image> back = decodeImage(bytes, "a.exr");
    ASSERT_TRUE(back) << back.error().message;
    EXPECT_TRUE(same(*back, image)) << channels;
    EXPECT_EQ(imageInfo(bytes, "a.exr")->channels, channels);
    EXPECT_EQ(imageInfo(bytes, "a.exr")->bytes(), back->bytes().size());
  }
  const Image half = randomImage(37, 19, 3, ComponentType::Half);
  EXPECT_TRUE(
      same(*decodeImage(written("a.exr", half), "a.exr"), converted(half, ComponentType::F32, 3)));
}

TEST_F(ImageFileTest, ExrLayersKeepNamesTypesAndBits) {
  const std::vector<ExrLayer> layers = {
      {"", {"R", "G", "B", "A"}, randomImage(8, 5, 4, ComponentType::Half, 1)},
      {"depth", {"Z"}, randomImage(8, 5, 1, ComponentType::F32, 2)},
      {"normal", {"X", "Y", "Z"}, randomImage(8, 5, 3, ComponentType::F32, 3)}};
  ASSERT_TRUE(writeExr(folder_ / "a.exr", layers));
  const auto back = readExrLayers(folder_ / "a.exr");
  ASSERT_TRUE(back) << back.error().message;
  ASSERT_EQ(back->size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ((*back)[i].name, layers[i].name);
    EXPECT_EQ((*back)[i].channels, layers[i].channels);
    EXPECT_TRUE(same((*back)[i].image, layers[i].image)) << layers[i].name;
  }
  const auto main = readImage(folder_ / "a.exr");
  ASSERT_TRUE(main);
  EXPECT_TRUE(same(*main, converted(layers[0].image, ComponentType::F32, 4)));
}

TEST_F(ImageFileTest, ExrWithoutAnUnnamedLayerNamesItsChannels) {
  ASSERT_TRUE(
      writeExr(folder_ / "a.exr", {{"a", {"R", "G"}, randomImage(4, 4, 2, ComponentType::F32)}}));
  EXPECT_THAT(readImage(folder_ / "a.exr").error().message, HasSubstr("a.G, a.R"));
}

TEST_F(ImageFileTest, HdrKeepsAHundredthOfTheBrightestComponent) {
  for (const int width : {5, 64, 300}) {
    Image image = randomImage(width, 9, 3, ComponentType::F32);
    for (float& value : image.as<float>()) value = std::exp2(20 * value - 10);
    std::fill_n(image.pixel<float>(0, 4), 3 * width, 2.5f);  // a row of one run
    std::fill_n(image.pixel<float>(0, 5), 3, 0.f);
    const auto back = decodeImage(written("a.hdr", image), "a.hdr");
    ASSERT_TRUE(back) << back.error().message;
    for (int y = 0; y < 9; ++y)
      for (int x = 0; x < width; ++x) {
        const float *a = image.pixel<float>(x, y), *b = back->pixel<float>(x, y);
        for (int c = 0; c < 3; ++c)
          ASSERT_NEAR(a[c], b[c], std::max({a[0], a[1], a[2]}) * 0.01f) << x << ' ' << y;
      }
  }
}

TEST_F(ImageFileTest, HdrHoldsExtremesWithoutWrapping) {
  Image image(1, 1, 3, ComponentType::F32);
  for (const float value : {255.9f / 256, 1e30f, 3e38f, 1e-30f, 1e-44f, 0.f, -1.f}) {
    std::fill_n(image.pixel<float>(0, 0), 3, value);
    const auto back = decodeImage(written("a.hdr", image), "a.hdr");
    const float wanted = value < 1e-38f ? 0.f : std::min(value, 1.69e38f);
    EXPECT_NEAR(*back->pixel<float>(0, 0), wanted, wanted * 0.01f);
  }
}

TEST_F(ImageFileTest, HdrRunsOfLengthZeroEnd) {
  Bytes bytes = written("a.hdr", randomImage(64, 2, 3, ComponentType::F32));
  const std::string header = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 64\n";
  std::fill(bytes.begin() + static_cast<int>(header.size()) + 4, bytes.end(), std::byte{0});
  EXPECT_THAT(decodeImage(bytes, "a.hdr").error().message, HasSubstr("scanline 0 is damaged"));
}

TEST_F(ImageFileTest, TgaAndBmpGiveTheirPixelsTopRowFirst) {
  for (const Bytes& bytes : {tga(false), tga(true), bmp()}) {
    const auto image = decodeImage(bytes, "unnamed");
    ASSERT_TRUE(image) << image.error().message;
    ASSERT_EQ(image->channels(), 3);
    const auto values = image->as<std::uint8_t>();
    EXPECT_THAT((std::vector<int>{values.begin(), values.end()}),
                ElementsAre(6, 5, 4, 9, 8, 7, 3, 2, 1, 3, 2, 1));
  }
}

TEST_F(ImageFileTest, JpegIsNearAndKeepsGrey) {
  Image image(32, 16, 3, ComponentType::U8);
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 32; ++x)
      for (int c = 0; c < 3; ++c)
        image.pixel<std::uint8_t>(x, y)[c] = static_cast<std::uint8_t>(8 * x - c * y);
  const auto back = decodeImage(jpeg(image), "a.jpg");
  ASSERT_TRUE(back) << back.error().message;
  for (std::size_t i = 0; i < image.bytes().size(); ++i)
    EXPECT_NEAR(back->as<std::uint8_t>()[i], image.as<std::uint8_t>()[i], 16);
  EXPECT_EQ(decodeImage(jpeg(converted(image, ComponentType::U8, 1)), "g.jpg")->channels(), 1);
}

TEST_F(ImageFileTest, ContentBeatsTheExtension) {
  const Bytes bytes = written("a.png", randomImage(3, 3, 3, ComponentType::U8));
  EXPECT_EQ(imageInfo(bytes, "really.jpg")->format, "PNG");
  EXPECT_TRUE(decodeImage(bytes, "really.jpg"));
}

TEST_F(ImageFileTest, EveryTruncationIsRefused) {
  const Image image = randomImage(24, 10, 3, ComponentType::F32);
  const Image u8 = converted(image, ComponentType::U8, 3);
  const std::vector<std::pair<std::string, Bytes>> files = {{"a.png", written("a.png", u8)},
                                                            {"a.exr", written("a.exr", image)},
                                                            {"a.hdr", written("a.hdr", image)},
                                                            {"a.jpg", jpeg(u8)},
                                                            {"a.tga", tga(false)},
                                                            {"r.tga", tga(true)},
                                                            {"a.bmp", bmp()}};
  for (const auto& [name, bytes] : files) {
    ASSERT_TRUE(decodeImage(bytes, name)) << name;
    // The end of a JPEG is a marker of two bytes that decoders supply; the BMP ends with padding.
    const std::size_t slack = name == "a.jpg" || name == "a.bmp" ? 2 : 0;
    for (std::size_t size = 0; size + slack < bytes.size(); ++size) {
      const auto result = decodeImage(std::span(bytes).first(size), name);
      ASSERT_FALSE(result) << name << " cut to " << size << " of " << bytes.size();
      ASSERT_EQ(result.error().kind, ErrorKind::Input);
      ASSERT_THAT(result.error().message, HasSubstr(name));
    }
  }
}

TEST_F(ImageFileTest, RandomDamageNeverDoesHarm) {
  const Image image = randomImage(24, 10, 3, ComponentType::F32);
  const Image u8 = converted(image, ComponentType::U8, 3);
  const std::vector<std::pair<std::string, Bytes>> files = {{"a.png", written("a.png", u8)},
                                                            {"a.exr", written("a.exr", image)},
                                                            {"a.hdr", written("a.hdr", image)},
                                                            {"a.jpg", jpeg(u8)},
                                                            {"r.tga", tga(true)},
                                                            {"a.bmp", bmp()}};
  ImageLimits limits;
  limits.maxBytes = 4 << 20;
  log::setLevel(log::Level::Off);  // much of it decodes with a warning
  Random random(7);
  for (const auto& [name, bytes] : files)
    for (int round = 0; round < 300; ++round) {
      Bytes damaged = bytes;
      for (std::uint32_t i = 0; i <= random.below(4); ++i)
        damaged[random.below(static_cast<std::uint32_t>(damaged.size()))] =
            static_cast<std::byte>(random.next());
      (void)decodeImage(damaged, name, limits);
    }
  log::setLevel(log::Level::Info);
}

TEST_F(ImageFileTest, DeclaredSizesAreCheckedBeforeAllocation) {
  Bytes png = written("a.png", randomImage(24, 10, 3, ComponentType::U8));
  const auto declare = [&](std::uint32_t width, std::uint32_t height) {
    for (std::size_t i = 0; i < 4; ++i) {
      png[16 + i] = static_cast<std::byte>(width >> (24 - 8 * i));
      png[20 + i] = static_cast<std::byte>(height >> (24 - 8 * i));
    }
    return decodeImage(png, "a.png").error().message;
  };
  EXPECT_THAT(declare(30000, 16000), HasSubstr("truncated or corrupt"));
  EXPECT_THAT(declare(100000, 2), HasSubstr("at most 32768 a side"));
  EXPECT_THAT(declare(32768, 32768), HasSubstr("take 3 GiB once decoded; at most 2 GiB are read"));
  EXPECT_THAT(declare(0, 5), HasSubstr("a size of zero"));
  EXPECT_THAT(declare(24, 11), HasSubstr("IHDR: CRC error"));
}

// A chunk of a PNG with its checksum.
void putChunk(Bytes& png, const std::string& type, const Bytes& data) {
  const auto put32 = [&](std::uint32_t value) {
    for (int shift = 24; shift >= 0; shift -= 8)
      png.push_back(static_cast<std::byte>(value >> shift));
  };
  put32(static_cast<std::uint32_t>(data.size()));
  const std::size_t begin = png.size();
  for (const char c : type) png.push_back(static_cast<std::byte>(c));
  png.insert(png.end(), data.begin(), data.end());
  put32(static_cast<std::uint32_t>(crc32(0, reinterpret_cast<const Bytef*>(&png[begin]),
                                         static_cast<uInt>(png.size() - begin))));
}

// 1.6 GB of text in 1.6 MB: libpng would inflate each text and keep it.
TEST_F(ImageFileTest, TextsOfAPngAreNotInflated) {
  const Bytes text(40 << 20, std::byte{'a'});
  uLongf size = compressBound(text.size());
  Bytes deflated(size);
  ASSERT_EQ(compress(reinterpret_cast<Bytef*>(deflated.data()), &size,
                     reinterpret_cast<const Bytef*>(text.data()), text.size()),
            Z_OK);
  deflated.resize(size);
  Bytes data{std::byte{'k'}, std::byte{0}, std::byte{0}};  // keyword, its end, deflate
  data.insert(data.end(), deflated.begin(), deflated.end());

  const Image image = randomImage(4, 3, 3, ComponentType::U8);
  const Bytes plain = written("a.png", image);
  constexpr std::size_t kHeaderEnd = 33;
  Bytes png(plain.begin(), plain.begin() + kHeaderEnd);
  for (int i = 0; i < 40; ++i) putChunk(png, "zTXt", data);
  png.insert(png.end(), plain.begin() + kHeaderEnd, plain.end());
  const auto kibibytes = [] {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss;
  };
  const long before = kibibytes();
  const auto back = decodeImage(png, "a.png");
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_TRUE(same(*back, image));
  EXPECT_LT(kibibytes() - before, 64 << 10);
}

// A float takes four times what a byte takes.
TEST_F(ImageFileTest, BytesAreLimitedNotPixels) {
  const ImageLimits limits{.maxBytes = 1000};
  const Image u8 = randomImage(16, 16, 3, ComponentType::U8);
  const Image f32 = converted(u8, ComponentType::F32, 3);
  EXPECT_TRUE(decodeImage(written("a.png", u8), "a.png", limits));
  for (const char* name : {"a.hdr", "a.exr"})
    EXPECT_THAT(decodeImage(written(name, f32), name, limits).error().message,
                HasSubstr("declares 16x16 pixels, which take 3 KiB once decoded; at most 1000 B"));
}

TEST_F(ImageFileTest, LimitsHoldForAllLayersAndPartsOfAnExr) {
  const Image color = randomImage(8, 5, 4, ComponentType::F32);
  const Image depth = randomImage(8, 5, 1, ComponentType::F32);
  ASSERT_TRUE(
      writeExr(folder_ / "a.exr", {{"", {"R", "G", "B", "A"}, color}, {"d", {"Z"}, depth}}));
  const Bytes two = *readFile(folder_ / "a.exr");
  EXPECT_EQ(decodeExrLayers(two, "a.exr", {.maxBytes = 800})->size(), 2u);
  EXPECT_THAT(decodeExrLayers(two, "a.exr", {.maxBytes = 799}).error().message,
              HasSubstr("its layers take more than 799 B"));

  Bytes parts = *readFile(fs::path(LUCERNA_SOURCE_DIR) / "tests/fuzz/corpus/exr/parts.exr");
  const std::string_view text(reinterpret_cast<const char*>(parts.data()), parts.size());
  constexpr std::string_view kWindow{"dataWindow\0box2i", 16};
  parts[text.rfind(kWindow) + kWindow.size() + 1 + 4 + 8] = std::byte{199};  // its right side
  EXPECT_THAT(decodeExrLayers(parts, "a.exr", {.maxSide = 100}).error().message,
              HasSubstr("part 2 has 200x4 pixels; at most 100 a side"));
}

TEST_F(ImageFileTest, WhatIsNoPictureIsNamed) {
  const std::string text = "hello, this is no picture at all";
  const auto bytes = std::as_bytes(std::span(text));
  EXPECT_THAT(decodeImage(bytes, "a.txt").error().message,
              HasSubstr("begins with 68 65 6c 6c 6f 2c 20 74, which is none of PNG"));
  EXPECT_THAT(decodeImage(bytes, "a.png").error().message, HasSubstr("signature is damaged"));
  EXPECT_THAT(decodeImage({}, "a.png").error().message, HasSubstr("is empty"));
  EXPECT_THAT(readImage(folder_ / "absent.png").error().message, HasSubstr("cannot be opened"));
}

TEST_F(ImageFileTest, WritingTheWrongKindLeavesNoFile) {
  const Image u8(2, 2, 3, ComponentType::U8), f32(2, 2, 3, ComponentType::F32);
  EXPECT_THAT(writeImage(folder_ / "a.png", f32).error().message, HasSubstr("not floats"));
  EXPECT_THAT(writeImage(folder_ / "a.exr", u8).error().message, HasSubstr("linear floats"));
  EXPECT_THAT(writeImage(folder_ / "a.hdr", u8).error().message, HasSubstr("linear floats"));
  EXPECT_EQ(writeImage(folder_ / "a.gif", u8).error().kind, ErrorKind::Usage);
  EXPECT_TRUE(fs::is_empty(folder_.path()));
}

TEST(CorruptPng, OfThePngSuiteIsRefusedWithAReason) {
  const fs::path folder = fs::path(LUCERNA_SOURCE_DIR) / "../shared/scenes/malformed/png_corrupt";
  if (!fs::exists(folder)) GTEST_SKIP() << folder << " is missing";
  const std::pair<const char*, const char*> cases[] = {
      {"corrupt_xc1n0g08.png", "colour type 1 does not exist"},
      {"corrupt_xd0n2c08.png", "bit depth"},
      {"corrupt_xdtn0g01.png", "IDAT"},
      {"corrupt_xhdn0g08.png", "IHDR: CRC error"},
      {"corrupt_xlfn0g04.png", "signature is damaged"},
      {"corrupt_xs1n0g01.png", "signature is damaged"}};
  for (const auto& [name, reason] : cases) {
    const auto image = readImage(folder / name);
    ASSERT_FALSE(image) << name;
    EXPECT_THAT(image.error().message, testing::AllOf(HasSubstr(name), HasSubstr(reason)));
  }
}

}  // namespace
}  // namespace lucerna
