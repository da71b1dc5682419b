#include "app/frame_name.hpp"

#include <gmock/gmock.h>

namespace lucerna::app {
namespace {

using testing::HasSubstr;

TEST(FrameName, NumbersFrames) {
  EXPECT_EQ(FrameName::parse("f-%04d.png", 3)->at(7), "f-0007.png");
  EXPECT_EQ(FrameName::parse("f-%04d.png", 3)->at(123456), "f-123456.png");
  EXPECT_EQ(FrameName::parse("%d.exr", 3)->at(12), "12.exr");
  EXPECT_EQ(FrameName::parse("100%%-%03d.hdr", 3)->at(1), "100%-001.hdr");
  EXPECT_EQ(FrameName::parse("plain.png", 1)->at(0), "plain.png");
  EXPECT_EQ(FrameName::parse("f-%02d.png", 1)->at(0), "f-00.png");
}

TEST(FrameName, KnowsTheKindByTheExtension) {
  EXPECT_EQ(FrameName::parse("a.PNG", 1)->kind(), OutputKind::Png);
  EXPECT_EQ(FrameName::parse("a.exr", 1)->kind(), OutputKind::Exr);
  EXPECT_EQ(FrameName::parse("a.hdr", 1)->kind(), OutputKind::Hdr);
}

TEST(FrameName, RefusesWhatItCannotWrite) {
  const auto faultOf = [](const char* pattern, std::uint64_t frames) {
    const auto name = FrameName::parse(pattern, frames);
    if (name) return std::string("it succeeded");
    EXPECT_EQ(name.error().kind, ErrorKind::Usage);
    return name.error().message;
  };
  EXPECT_THAT(faultOf("a.pgn", 1), HasSubstr("did you mean '.png'"));
  EXPECT_THAT(faultOf("a", 1), HasSubstr(".png, .exr, .hdr"));
  EXPECT_THAT(faultOf("a.png", 2), HasSubstr("frame-%04d.png"));
  for (const char* bad :
       {"%s.png", "%.png", "%4d.png", "%00d.png", "%0d.png", "%n%n.png", "%d-%d.png", "%012d.png"})
    EXPECT_THAT(faultOf(bad, 1), HasSubstr("not a frame number")) << bad;
}

}  // namespace
}  // namespace lucerna::app
