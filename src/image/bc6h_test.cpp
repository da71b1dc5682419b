#include "image/bc6h.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <bitset>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "core/parallel.hpp"
#include "core/random.hpp"
#include "image/bc6h_slow_decoder.hpp"

namespace lucerna {
namespace {

Bc6hBlock randomBlock(Random& random) {
  Bc6hBlock block;
  for (std::byte& byte : block) byte = static_cast<std::byte>(random.next() >> 24);
  return block;
}

Bc6hBlock withMode(Bc6hBlock block, unsigned number) {
  const unsigned mask = number < 2 ? 3 : 31;
  block[0] = static_cast<std::byte>((std::to_integer<unsigned>(block[0]) & ~mask) | number);
  return block;
}

TEST(Bc6hDecode, AgreesWithASlowDecoderInAllModesAndPartitions) {
  Random random(1);
  for (const SlowMode& mode : kSlowModes)
    for (int round = 0; round < 3000; ++round) {
      Bc6hBlock block = withMode(randomBlock(random), mode.number);
      // Among them endpoints of zeros and of ones only, which are exceptions.
      if (round % 10 == 0)
        for (std::size_t i = 1; i < 10; ++i)
          if (random.below(4) == 0) block[i] = static_cast<std::byte>(round % 20 == 0 ? 0xff : 0);
      ASSERT_EQ(decodeBc6hBlock(block), slowDecode(block)) << mode.number << ' ' << round;
    }
}

// 16 bits are written out: red 0x1234, green 0xffff, blue 0; no offsets. The indices do not matter.
TEST(Bc6hDecode, HasTheValuesOfItsDefinition) {
  BlockBits bits;
  bits |= BlockBits(0b01111);
  const auto put = [&](const char* places, unsigned value) {
    const auto list = placesOf(places);
    for (std::size_t i = 0; i < list.size(); ++i) bits[list[i]] = (value >> i & 1) != 0;
  };
  put("5-14 44 43 42 41 40 39", 0x1234);
  put("15-24 54 53 52 51 50 49", 0xffff);
  Bc6hBlock block = {};
  for (std::size_t i = 0; i < 128; ++i)
    block[i / 8] |= static_cast<std::byte>(static_cast<unsigned>(bits[i]) << i % 8);
  const std::array<std::uint16_t, 3> wanted = {0x1234 * 31 / 64, 0x7bff, 0};
  for (const auto& texel : decodeBc6hBlock(block)) EXPECT_EQ(texel, wanted);
}

TEST(Bc6hDecode, ReservedModesAreBlack) {
  Random random(2);
  for (const unsigned number : {0b10011u, 0b10111u, 0b11011u, 0b11111u})
    for (int round = 0; round < 100; ++round)
      ASSERT_EQ(decodeBc6hBlock(withMode(randomBlock(random), number)), Bc6hTexels{});
}

TEST(Bc6hEncode, ConstantBlocksAreExact) {
  Random random(3);
  for (unsigned half = 0; half <= 0x7bff; ++half) {
    const std::array<std::uint16_t, 3> color = {static_cast<std::uint16_t>(half),
                                                static_cast<std::uint16_t>(random.below(0x7c00)),
                                                static_cast<std::uint16_t>(0x7bff - half)};
    Bc6hTexels texels;
    texels.fill(color);
    const Bc6hBlock block = encodeBc6hBlock(texels);
    ASSERT_EQ(decodeBc6hBlock(block), texels) << half;
    ASSERT_EQ(slowDecode(block), texels) << half;
  }
}

// As bc6h.hpp states it, over the 16 texels.
double errorOf(const Bc6hTexels& wanted, const Bc6hTexels& found) {
  const auto brightest = [](const auto& color) {
    return double{floatFromHalf(*std::ranges::max_element(color))};
  };
  double largest = 0, sum = 0;
  for (const auto& color : wanted) largest = std::max(largest, brightest(color));
  for (int t = 0; t < 16; ++t)
    for (int c = 0; c < 3; ++c) {
      const double error = double{floatFromHalf(found[t][c])} - double{floatFromHalf(wanted[t][c])};
      sum += std::pow(error / std::max(brightest(wanted[t]) + largest / 1024, 0x1p-24), 2);
    }
  return sum;
}

Bc6hTexels throughBc6h(const Bc6hTexels& texels) {
  const Bc6hBlock block = encodeBc6hBlock(texels);
  const Bc6hTexels found = decodeBc6hBlock(block);
  EXPECT_EQ(found, slowDecode(block));
  return found;
}

// The root of the mean of errorOf() over the texels.
double rootMeanError(const std::vector<Bc6hTexels>& blocks) {
  double sum = 0;
  for (const Bc6hTexels& texels : blocks) sum += errorOf(texels, throughBc6h(texels));
  return std::sqrt(sum / static_cast<double>(16 * blocks.size()));
}

template <typename ColorAt>
Bc6hTexels blockOf(ColorAt colorAt) {
  Bc6hTexels texels;
  for (int t = 0; t < 16; ++t) {
    const std::array<float, 3> color = colorAt(t % 4, t / 4);
    for (int c = 0; c < 3; ++c) texels[t][c] = halfFromFloat(color[c]);
  }
  return texels;
}

std::array<float, 3> randomColor(Random& random) {
  return {random.uniform(0.2f, 1.f), random.uniform(0.2f, 1.f), random.uniform(0.2f, 1.f)};
}
std::array<float, 3> mixed(const std::array<float, 3>& a, const std::array<float, 3>& b, float f) {
  return {a[0] + f * (b[0] - a[0]), a[1] + f * (b[1] - a[1]), a[2] + f * (b[2] - a[2])};
}
std::array<float, 3> scaled(const std::array<float, 3>& a, float factor) {
  return {a[0] * factor, a[1] * factor, a[2] * factor};
}

enum class Content { Gradient, Edge, Grey, Noise };

std::vector<Bc6hTexels> blocksOf(Content content, float scale, std::uint64_t seed) {
  Random random(seed);
  std::vector<Bc6hTexels> blocks;
  for (int i = 0; i < 400; ++i) {
    const auto a = scaled(randomColor(random), scale), b = scaled(randomColor(random), scale);
    const float angle = random.uniform(0.f, 6.2832f), cosine = std::cos(angle),
                sine = std::sin(angle), tone = random.uniform(0.01f, 0.2f);
    blocks.push_back(blockOf([&](int x, int y) {
      const float along =
          cosine * (static_cast<float>(x) - 1.5f) + sine * (static_cast<float>(y) - 1.5f);
      switch (content) {
        case Content::Gradient:  // in shades and hue by some percent a texel
          return mixed(a, b, 0.5f + tone * along / 3.f);
        case Content::Edge:
          return along > 0 ? a : scaled(b, 0.1f);
        case Content::Grey:
          return scaled(a, 1.f + tone * random.uniform(-1.f, 1.f));
        case Content::Noise:
          break;
      }
      return scaled(randomColor(random), scale);
    }));
  }
  return blocks;
}

// The bounds are some tenths above what was measured. Of noise one line, or two, keeps a part only.
TEST(Bc6hEncode, KeepsSmoothBlocksEdgesAndNoiseOverTheWholeRange) {
  const std::pair<Content, double> bounds[] = {{Content::Gradient, 0.0035},
                                               {Content::Edge, 0.0085},
                                               {Content::Grey, 0.0085},
                                               {Content::Noise, 0.33}};
  for (const auto& [content, bound] : bounds)
    for (const float scale : {1e-3f, 1e-2f, 1.f, 30.f, 1e3f, 5e4f})
      EXPECT_LT(rootMeanError(blocksOf(content, scale, 7)), bound)
          << static_cast<int>(content) << " times " << scale;
}

// Halves below 2^-14 lie 2^-24 apart, 1/160 of 1e-5: lines across octaves have the wrong steps
// there.
TEST(Bc6hEncode, KeepsDarkGradientsAndEdges) {
  EXPECT_LT(rootMeanError(blocksOf(Content::Gradient, 1e-4f, 7)), 0.0045);
  EXPECT_LT(rootMeanError(blocksOf(Content::Edge, 1e-4f, 7)), 0.06);
}

TEST(Bc6hEncode, BlackBesideLightStaysDark) {
  Random random(5);
  for (int round = 0; round < 500; ++round) {
    const auto light = randomColor(random);
    const Bc6hTexels wanted = blockOf([&](int x, int y) {
      return x + y < static_cast<int>(random.below(6)) ? scaled(light, random.uniform(0.8f, 1.f))
                                                       : std::array<float, 3>{};
    });
    const Bc6hTexels found = throughBc6h(wanted);
    for (int t = 0; t < 16; ++t)
      for (int c = 0; c < 3; ++c)
        if (wanted[t][c] == 0) {
          ASSERT_LE(floatFromHalf(found[t][c]), 1e-3f) << round;
        }
  }
}

// Blocks that a mode says exactly are found again within steps that grow as its bits get fewer, and
// mostly in that mode.
TEST(Bc6hEncode, FindsBlocksThatTheFormatCanSay) {
  const std::vector<std::pair<unsigned, double>> bounds = {
      {0b00, 0.007},    {0b01, 0.09},     {0b00010, 0.0035}, {0b00110, 0.003},
      {0b01010, 0.003}, {0b01110, 0.013}, {0b10010, 0.035},  {0b10110, 0.035},
      {0b11010, 0.035}, {0b00111, 0.027}, {0b01011, 0.006},  {0b01111, 0.0003}};
  Random random(6);
  for (const auto& [number, bound] : bounds) {
    std::vector<Bc6hTexels> blocks;
    int uses = 0;
    while (blocks.size() < 200) {
      const Bc6hTexels texels = slowDecode(withMode(randomBlock(random), number));
      // Where offsets wrap around, ends lie at both ends of all halves.
      const bool wraps = std::ranges::any_of(texels, [](const auto& color) {
        return std::ranges::max(color) > 0x7000 || std::ranges::min(color) < 0x1000;
      });
      if (wraps) continue;
      blocks.push_back(texels);
      const SlowMode* mode = slowModeOf(bitsOf(encodeBc6hBlock(texels)));
      ASSERT_TRUE(mode);
      uses += mode->number == number ? 1 : 0;
    }
    EXPECT_GT(uses, 90) << number;
    EXPECT_LT(rootMeanError(blocks), bound) << number;
  }
}

Image randomImage(int width, int height, int channels, std::uint64_t seed) {
  Random random(seed);
  Image image(width, height, channels, ComponentType::F32);
  for (float& value : image.as<float>()) value = std::exp2(random.uniform(-8.f, 8.f));
  return image;
}

TEST(Bc6hImage, RepeatsItsLastRowsAndColumns) {
  for (const auto& [width, height] : {std::pair{5, 3}, {1, 1}, {4, 9}, {7, 4}}) {
    const Image image = randomImage(width, height, 3, 9);
    Image whole((width + 3) / 4 * 4, (height + 3) / 4 * 4, 3, ComponentType::F32);
    for (int y = 0; y < whole.height(); ++y)
      for (int x = 0; x < whole.width(); ++x)
        std::copy_n(image.pixel<float>(std::min(x, width - 1), std::min(y, height - 1)), 3,
                    whole.pixel<float>(x, y));
    const Bytes blocks = encodeBc6h(image);
    EXPECT_EQ(blocks.size(), bc6hBytes(width, height));
    EXPECT_EQ(blocks, encodeBc6h(whole)) << width << 'x' << height;
    const Image back = decodeBc6h(blocks, width, height),
                all = decodeBc6h(blocks, whole.width(), whole.height());
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        for (int c = 0; c < 3; ++c)
          ASSERT_EQ(back.pixel<float>(x, y)[c], all.pixel<float>(x, y)[c]);
  }
}

TEST(Bc6hImage, IsTheSameForAnyNumberOfThreadsAndKindOfFloat) {
  const Image image = converted(randomImage(61, 83, 4, 10), ComponentType::Half, 4);
  const int before = threadCount();
  setThreadCount(1);
  const Bytes one = encodeBc6h(image);
  setThreadCount(4);
  EXPECT_EQ(encodeBc6h(image), one);
  EXPECT_EQ(encodeBc6h(converted(image, ComponentType::F32, 4)), one);
  EXPECT_EQ(encodeBc6h(converted(image, ComponentType::F32, 3)), one);
  setThreadCount(before);
}

TEST(Bc6hImage, TakesWhatIsOutOfRangeForTheNearest) {
  const float nan = std::numeric_limits<float>::quiet_NaN(),
              infinite = std::numeric_limits<float>::infinity();
  Image image(1, 1, 3, ComponentType::F32);
  const auto through = [&](float r, float g, float b) {
    const float color[] = {r, g, b};
    std::copy_n(color, 3, image.pixel<float>(0, 0));
    const Image back = decodeBc6h(encodeBc6h(image), 1, 1);
    const auto values = back.as<float>();
    return std::vector<float>(values.begin(), values.end());
  };
  EXPECT_THAT(through(-1.f, nan, -infinite), testing::ElementsAre(0.f, 0.f, 0.f));
  EXPECT_THAT(through(infinite, 1e6f, 65519.f),
              testing::ElementsAre(kLargestBc6h, kLargestBc6h, kLargestBc6h));
}

}  // namespace
}  // namespace lucerna
