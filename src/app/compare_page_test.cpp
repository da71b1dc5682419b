#include "app/compare_page.hpp"

#include <gmock/gmock.h>

namespace lucerna::app {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

Image picture(float value) {
  Image image(2, 1, 3, ComponentType::F32);
  std::ranges::fill(image.as<float>(), value);
  return image;
}

std::string pageOf(Comparison comparison) {
  comparison.reference = picture(0.5f);
  comparison.test = picture(0.25f);
  comparison.flip = flipLdr(comparison.reference, comparison.test);
  comparison.pixels = pixelMetrics(comparison.reference, comparison.test);
  const auto page = comparePage(comparison, heatMap(comparison.flip.error));
  EXPECT_TRUE(page) << page.error().message;
  return page ? *page : "";
}

// 1, -2 and 0.1 as half floats: 3c00, c000, 2e66.
TEST(ComparePage, HighBytesOfHalvesLieAboveTheLowBytes) {
  Image image(3, 1, 1, ComponentType::F32);
  std::ranges::copy(std::array{1.f, -2.f, 0.1f}, image.as<float>().begin());
  const Image bytes = halvesAsBytes(image);
  EXPECT_EQ(bytes.height(), 2);
  EXPECT_THAT(bytes.as<std::uint8_t>(), ElementsAre(0x3c, 0xc0, 0x2e, 0, 0, 0x66));
}

TEST(ComparePage, NamesAreEscapedAndNumbersStandInTheTable) {
  const std::string page = pageOf({.referenceName = "in/<a>.png", .testName = "b&.png"});
  EXPECT_THAT(page, AllOf(HasSubstr("<title>b&amp;.png beside &lt;a&gt;.png</title>"),
                          HasSubstr("Reference: in/&lt;a&gt;.png"), HasSubstr("<td>0.250000</td>"),
                          HasSubstr("<td>12.041 dB</td>")));
}

TEST(ComparePage, ValuesOfBytesAreReadFromThePicturesThemselves) {
  EXPECT_THAT(pageOf({.eightBit = true}),
              AllOf(HasSubstr("\"values\":\"bytes\""), Not(HasSubstr("id=\"test-values\""))));
  EXPECT_THAT(pageOf({.hdr = true}),
              AllOf(HasSubstr("\"values\":\"linear\""), HasSubstr("id=\"test-values\"")));
  EXPECT_THAT(pageOf({}),
              AllOf(HasSubstr("\"values\":\"encoded\""), HasSubstr("id=\"test-values\"")));
}

}  // namespace
}  // namespace lucerna::app
