#include "image/image.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

namespace lucerna {
namespace {

using testing::ElementsAre;

Image pixelU8(std::vector<std::uint8_t> values) {
  Image image(1, 1, static_cast<int>(values.size()), ComponentType::U8);
  std::copy(values.begin(), values.end(), image.as<std::uint8_t>().begin());
  return image;
}

std::vector<int> channelsOf(const Image& image) {
  const auto values = image.as<std::uint8_t>();
  return {values.begin(), values.end()};
}

TEST(Convert, FillsAndDropsChannels) {
  const auto u8 = ComponentType::U8;
  EXPECT_THAT(channelsOf(converted(pixelU8({7}), u8, 4)), ElementsAre(7, 7, 7, 255));
  EXPECT_THAT(channelsOf(converted(pixelU8({7}), u8, 2)), ElementsAre(7, 255));
  EXPECT_THAT(channelsOf(converted(pixelU8({7, 9}), u8, 4)), ElementsAre(7, 7, 7, 9));
  EXPECT_THAT(channelsOf(converted(pixelU8({7, 9}), u8, 3)), ElementsAre(7, 7, 7));
  EXPECT_THAT(channelsOf(converted(pixelU8({1, 2, 3}), u8, 4)), ElementsAre(1, 2, 3, 255));
  EXPECT_THAT(channelsOf(converted(pixelU8({1, 2, 3, 4}), u8, 3)), ElementsAre(1, 2, 3));
  EXPECT_THAT(channelsOf(converted(pixelU8({1, 2, 3, 4}), u8, 2)), ElementsAre(1, 4));
  EXPECT_THAT(channelsOf(converted(pixelU8({1, 2, 3, 4}), u8, 1)), ElementsAre(1));
}

TEST(Convert, EveryByteSurvivesEveryType) {
  Image image(256, 1, 1, ComponentType::U8);
  for (int i = 0; i < 256; ++i) *image.pixel<std::uint8_t>(i, 0) = static_cast<std::uint8_t>(i);
  for (const auto type : {ComponentType::U16, ComponentType::Half, ComponentType::F32}) {
    const Image back = converted(converted(image, type, 1), ComponentType::U8, 1);
    EXPECT_EQ(channelsOf(back), channelsOf(image));
  }
  EXPECT_EQ(*converted(image, ComponentType::U16, 1).pixel<std::uint16_t>(255, 0), 65535);
  EXPECT_EQ(*converted(image, ComponentType::F32, 1).pixel<float>(255, 0), 1.f);
}

TEST(Convert, ClampsFloatsAndTurnsNanToBlack) {
  Image image(4, 1, 1, ComponentType::F32);
  const float values[] = {-1, 2, std::numeric_limits<float>::quiet_NaN(), 0.5f};
  std::copy(std::begin(values), std::end(values), image.as<float>().begin());
  EXPECT_THAT(channelsOf(converted(image, ComponentType::U8, 1)), ElementsAre(0, 255, 0, 128));
}

TEST(Half, RoundsToNearestEven) {
  EXPECT_EQ(halfFromFloat(1.f), 0x3c00);
  EXPECT_EQ(halfFromFloat(65504.f), 0x7bff);
  EXPECT_EQ(halfFromFloat(1e6f), 0x7c00);
  EXPECT_EQ(halfFromFloat(1.f + 0x1p-11f), 0x3c00) << "a tie goes to the even neighbour";
  for (std::uint32_t bits = 0; bits < 0x7c00; ++bits)
    ASSERT_EQ(halfFromFloat(floatFromHalf(static_cast<std::uint16_t>(bits))), bits);
}

TEST(Srgb, RoundTripsAndClamps) {
  for (int i = 0; i <= 255; ++i) {
    const float encoded = static_cast<float>(i) / 255;
    EXPECT_NEAR(srgbFromLinear(linearFromSrgb(encoded)), encoded, 1e-6f);
  }
  EXPECT_NEAR(linearFromSrgb(0.5f), 0.21404f, 1e-5f);
  EXPECT_EQ(srgbFromLinear(-1.f), 0.f);
  EXPECT_NEAR(srgbFromLinear(7.f), 1.f, 1e-6f);
}

TEST(Image, FlipsVertically) {
  Image image(2, 3, 1, ComponentType::U8);
  for (int i = 0; i < 6; ++i) image.as<std::uint8_t>()[i] = static_cast<std::uint8_t>(i);
  EXPECT_THAT(channelsOf(flippedVertically(image)), ElementsAre(4, 5, 2, 3, 0, 1));
}

}  // namespace
}  // namespace lucerna
