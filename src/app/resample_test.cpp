#include "app/resample.hpp"

#include <gtest/gtest.h>

namespace lucerna::app {
namespace {

Image ramp(int width, int height) {
  Image image(width, height, 3, ComponentType::F32);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      float* pixel = image.pixel<float>(x, y);
      pixel[0] = (static_cast<float>(x) + 0.5f) / static_cast<float>(width);
      pixel[1] = (static_cast<float>(y) + 0.5f) / static_cast<float>(height);
      pixel[2] = 0.25f;
    }
  return image;
}

TEST(Resample, HandsBackWhatHasTheSize) {
  const auto isSame = [](Image (*resized)(Image, uvec2), ComponentType type) {
    Image image = converted(ramp(64, 32), type, 3);
    const std::byte* pixels = image.bytes().data();
    return resized(std::move(image), {64, 32}).bytes().data() == pixels;
  };
  EXPECT_TRUE(isSame(resizedLinear, ComponentType::F32));
  EXPECT_TRUE(isSame(resizedNearest, ComponentType::F32));
  EXPECT_TRUE(isSame(resizedSrgb, ComponentType::U8));
}

// A linear ramp keeps its values at the new pixel centres (a tent sampled at uneven places is off
// by a thousandth); constants stay constant, edges included.
TEST(Resample, KeepsRampsAndConstants) {
  for (const uvec2 size : {uvec2(32, 16), uvec2(128, 64), uvec2(48, 90), uvec2(64, 32)}) {
    const Image result = resizedLinear(ramp(64, 32), size);
    const Image wanted = ramp(static_cast<int>(size.x), static_cast<int>(size.y));
    ASSERT_EQ(result.width(), wanted.width());
    ASSERT_EQ(result.height(), wanted.height());
    for (int y = 4; y < result.height() - 4; ++y)
      for (int x = 4; x < result.width() - 4; ++x)
        for (int c = 0; c < 2; ++c)
          ASSERT_NEAR(result.pixel<float>(x, y)[c], wanted.pixel<float>(x, y)[c], 1e-3f)
              << x << " " << y;
    for (std::size_t i = 2; i < result.as<float>().size(); i += 3)
      ASSERT_NEAR(result.as<float>()[i], 0.25f, 1e-6f);
  }
}

TEST(Resample, MixesInLinearLight) {
  Image checker(4, 4, 3, ComponentType::U8);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 4; ++x)
      for (int c = 0; c < 3; ++c) checker.pixel<std::uint8_t>(x, y)[c] = (x + y) % 2 ? 255 : 0;
  const Image small = resizedSrgb(checker, {1, 1});
  // Half the light is 188 in sRGB, not 128.
  EXPECT_NEAR(small.pixel<std::uint8_t>(0, 0)[0], 188, 2);
}

TEST(Resample, NearestTakesOnePixel) {
  Image image(2, 1, 1, ComponentType::F32);
  image.pixel<float>(0, 0)[0] = std::numeric_limits<float>::infinity();
  image.pixel<float>(1, 0)[0] = 3.f;
  const Image wide = resizedNearest(image, {4, 2});
  EXPECT_EQ(wide.pixel<float>(1, 1)[0], std::numeric_limits<float>::infinity());
  EXPECT_EQ(wide.pixel<float>(2, 0)[0], 3.f);
}

}  // namespace
}  // namespace lucerna::app
