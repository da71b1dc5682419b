#include "core/svg.hpp"

#include <gmock/gmock.h>

namespace lucerna {
namespace {

using testing::HasSubstr;

TEST(Svg, TextsAreEscaped) {
  EXPECT_EQ(svgText({1, 2.5}, "end", "a<b"),
            "<text x=\"1.00\" y=\"2.50\" text-anchor=\"end\">a&lt;b</text>\n");
  EXPECT_THAT(svgRect({0, 0}, {1, 2}, "#fff", "a&b"), HasSubstr("<title>a&amp;b</title></rect>"));
}

TEST(Svg, ADrawingHasItsSize) {
  EXPECT_THAT(svgDrawing(300, 200, "<g/>"), HasSubstr("viewBox=\"0 0 300 200\" width=\"300\""));
}

TEST(Svg, AnAxisHasTwoToFiveRoundSteps) {
  EXPECT_DOUBLE_EQ(roundStep(1), 0.5);
  EXPECT_DOUBLE_EQ(roundStep(4.9), 1);
  EXPECT_DOUBLE_EQ(roundStep(730), 250);
  for (double largest = 1e-4; largest < 1e4; largest *= 1.07) {
    EXPECT_GE(largest / roundStep(largest), 2 - 1e-9) << largest;
    EXPECT_LE(largest / roundStep(largest), 5 + 1e-9) << largest;
  }
}

}  // namespace
}  // namespace lucerna
