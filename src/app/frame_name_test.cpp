#include "app/frame_name.hpp"

#include <gmock/gmock.h>

namespace lucerna::app {
namespace {

using testing::HasSubstr;

TEST(FrameName, NamesEveryFrameOrTheOneFile) {
  EXPECT_EQ(FrameName::parse("f-%04d.png", 3)->at(7), "f-0007.png");
  EXPECT_EQ(FrameName::parse("plain.png", 1)->at(0), "plain.png");
  EXPECT_EQ(FrameName::parse("a.mkv", 100)->at(99), "a.mkv");
}

TEST(FrameName, KnowsTheKindByTheExtension) {
  EXPECT_EQ(FrameName::parse("a.PNG", 1)->kind(), OutputKind::Png);
  EXPECT_EQ(FrameName::parse("a.exr", 1)->kind(), OutputKind::Exr);
  EXPECT_EQ(FrameName::parse("a.hdr", 1)->kind(), OutputKind::Hdr);
  EXPECT_EQ(FrameName::parse("a.mp4", 1)->kind(), OutputKind::Video);
  EXPECT_EQ(FrameName::parse("a.MKV", 1)->kind(), OutputKind::Video);
}

TEST(FrameName, RefusesWhatItCannotWrite) {
  const auto faultOf = [](const char* pattern, std::uint64_t frames) {
    const auto name = FrameName::parse(pattern, frames);
    if (name) return std::string("it succeeded");
    EXPECT_EQ(name.error().kind, ErrorKind::Usage);
    return name.error().message;
  };
  EXPECT_THAT(faultOf("a.pgn", 1), HasSubstr("did you mean '.png'"));
  EXPECT_THAT(faultOf("a", 1), HasSubstr(".png, .exr, .hdr, .mp4, .mkv"));
  EXPECT_THAT(faultOf("a.png", 2), HasSubstr("frame-%04d.png"));
  EXPECT_THAT(faultOf("a-%d.mp4", 2), HasSubstr("one file"));
  EXPECT_THAT(faultOf("%s.png", 1), HasSubstr("-o: '%s.png' has a '%'"));
}

}  // namespace
}  // namespace lucerna::app
