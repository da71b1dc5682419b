#include "app/row_files.hpp"

#include <gmock/gmock.h>

#include "app/session.hpp"

namespace lucerna::app {
namespace {

using testing::HasSubstr;

class RowFiles : public testing::Test {
 protected:
  // What is said of SaveImage rows A, B, ... with these files ("": the default) beside that of -o.
  std::string faultOf(const std::string& output, const std::vector<std::string>& files) {
    graph::Pipeline pipeline;
    for (const std::string& file : files) {
      graph::PassRow& row = pipeline.passes.emplace_back();
      row.name = std::string(1, static_cast<char>('A' + pipeline.passes.size() - 1));
      row.type = "SaveImage";
      if (!file.empty()) row.params["file"] = file;
      row.enabled = row.name != disabled_;
    }
    const Status status = checkRowFiles(
        pipeline, registry_, FrameName::parse(output, settings_.frames).value(), settings_);
    if (status) return "";
    EXPECT_EQ(status.error().kind, ErrorKind::Usage);
    return status.error().message;
  }

  graph::Registry registry_ = makeRegistry().value();
  RenderSettings settings_;
  std::string disabled_;
};

TEST_F(RowFiles, MayNotBeWrittenTwice) {
  EXPECT_EQ(faultOf("out.png", {""}), "");
  EXPECT_EQ(faultOf("out.png", {"", "other.png"}), "");
  EXPECT_EQ(faultOf("out.png", {"", ""}),
            "'A' and 'B' would write the same file, 'image-%04d.png'; give the row another one by "
            "--set B.file=NAME");
  disabled_ = "B";
  EXPECT_EQ(faultOf("out.png", {"", ""}), "");
}

TEST_F(RowFiles, MayNotBeThePicture) {
  EXPECT_THAT(faultOf("out.png", {"a.png", "out.png"}),
              HasSubstr("-o and 'B' would write the same file, 'out.png'"));
  EXPECT_THAT(faultOf("./out.png", {"out.png"}), HasSubstr("-o and 'A'"));
  EXPECT_THAT(faultOf("image-%04d.png", {""}), HasSubstr("-o and 'A'"));
  EXPECT_EQ(faultOf("out.exr", {"out.png"}), "");
}

TEST_F(RowFiles, AreComparedByTheNamesOfAllFrames) {
  settings_.frames = 20;
  EXPECT_THAT(faultOf("a.mp4", {"f-%d.png", "f-19.png"}), HasSubstr("'A' and 'B'"));
  EXPECT_EQ(faultOf("a.mp4", {"f-%d.png", "f-20.png"}), "");
  EXPECT_EQ(faultOf("a.mp4", {"f-%d.png", "f-07.png"}), "");
  EXPECT_THAT(faultOf("a.mp4", {"f-%d.png", "f-1%d.png"}), HasSubstr("'A' and 'B'")) << "f-12.png";
  EXPECT_THAT(faultOf("f-%d.png", {"f-%02d.png"}), HasSubstr("-o and 'A'")) << "f-12.png";
  EXPECT_EQ(faultOf("f-%d.png", {"f-%03d.png"}), "");
}

TEST_F(RowFiles, AreOneAnEye) {
  settings_.stereo.layout = StereoLayout::SideBySide;
  EXPECT_EQ(faultOf("out.png", {"out.png"}), "");
  EXPECT_THAT(faultOf("out-view1.png", {"out.png"}), HasSubstr("-o and 'A'"));
}

TEST_F(RowFiles, WithNamesThatTheRowRefusesAreNoFaultHere) {
  EXPECT_EQ(faultOf("out.png", {"%s.png", "%s.png"}), "");
}

}  // namespace
}  // namespace lucerna::app
