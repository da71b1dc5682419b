#include "app/settings.hpp"

#include <gtest/gtest.h>

namespace lucerna::app {
namespace {

TEST(Settings, SizesAreTwoNumbersWithinTheLimit) {
  EXPECT_EQ(*sizeFromText("1280x720"), uvec2(1280, 720));
  EXPECT_EQ(*sizeFromText("1X1"), uvec2(1, 1));
  EXPECT_EQ(*sizeFromText("65536x65536"), uvec2(65536));
  for (const char* bad : {"", "x", "1280", "1280x", "x720", "0x720", "-1x5", "1280x720x3",
                          "1280 x 720", "65537x1", "99999999999x1", "1.5x2"})
    EXPECT_FALSE(sizeFromText(bad)) << bad;
}

TEST(Settings, ScaleIsInPercentAndNeverReachesZero) {
  RenderSettings settings;
  settings.size = {1280, 721};
  EXPECT_EQ(settings.renderSize(), uvec2(1280, 721));
  settings.scale = 50;
  EXPECT_EQ(settings.renderSize(), uvec2(640, 361));
  settings.size = {1, 1};
  settings.scale = 25;
  EXPECT_EQ(settings.renderSize(), uvec2(1, 1));
}

}  // namespace
}  // namespace lucerna::app
