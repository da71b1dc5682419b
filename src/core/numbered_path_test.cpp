#include "core/numbered_path.hpp"

#include <gmock/gmock.h>

namespace lucerna {
namespace {

using testing::HasSubstr;

TEST(NumberedPath, PutsTheNumberInItsPlace) {
  EXPECT_EQ(NumberedPath::parse("f-%04d.png")->at(7), "f-0007.png");
  EXPECT_EQ(NumberedPath::parse("f-%04d.png")->at(123456), "f-123456.png");
  EXPECT_EQ(NumberedPath::parse("%d.exr")->at(12), "12.exr");
  EXPECT_EQ(NumberedPath::parse("100%%-%03d.hdr")->at(1), "100%-001.hdr");
  EXPECT_EQ(NumberedPath::parse("f-%02d.png")->at(0), "f-00.png");
  EXPECT_EQ(NumberedPath::parse("plain.png")->at(5), "plain.png");
  EXPECT_TRUE(NumberedPath::parse("%d")->numbered());
  EXPECT_FALSE(NumberedPath::parse("100%%")->numbered());
}

TEST(NumberedPath, RefusesOtherPercentSigns) {
  for (const char* bad : {"%s.png", "%.png", "%4d.png", "%00d.png", "%0d.png", "%n%n.png",
                          "%d-%d.png", "%012d.png"}) {
    const auto name = NumberedPath::parse(bad);
    ASSERT_FALSE(name) << bad;
    EXPECT_EQ(name.error().kind, ErrorKind::Usage);
    EXPECT_THAT(name.error().message, HasSubstr("not a frame number")) << bad;
  }
}

}  // namespace
}  // namespace lucerna
