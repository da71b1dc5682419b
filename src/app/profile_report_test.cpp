#include "app/profile_report.hpp"

#include <gmock/gmock.h>

#include "app/profile_summary.hpp"

namespace lucerna::app {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

graph::StepProfile step(const std::string& row, int view, double gpuMs) {
  gpu::Counters counters;
  counters.draws = 4;
  return {.row = row,
          .view = view,
          .cpuMs = gpuMs / 10,
          .gpuMs = gpuMs,
          .counters = counters,
          .textureBytes = 1 << 20};
}

graph::FrameProfile frame(std::uint64_t number, std::vector<graph::StepProfile> steps) {
  graph::FrameProfile result;
  result.frame = number;
  result.steps = std::move(steps);
  for (const graph::StepProfile& step : result.steps) result.gpuMs += step.gpuMs;
  return result;
}

// GPU ms of the pass "Ao|<b>" in frames 0 to 4: 100, 1, 2, 6, 3; of "Once" only in frame 2: 8.
ProfileLog exampleLog() {
  ProfileLog log({.scene = "a<b>",
                  .pipeline = "deferred",
                  .renderer = "llvmpipe",
                  .size = {64, 36},
                  .gpuClock = "gpu-timer"});
  log.add(frame(0, {step("Ao|<b>", 0, 100)}));
  log.add(frame(1, {step("Ao|<b>", 0, 1)}));
  log.add(frame(2, {step("Ao|<b>", 0, 2), step("Once", 0, 8)}));
  log.add(frame(3, {step("Ao|<b>", 0, 6)}));
  log.add(frame(4, {step("Ao|<b>", 0, 3)}));
  return log;
}

TEST(ProfileReport, MeansAndMediansAreOfAllFramesButTheFirst) {
  const ProfileSummary summary = summarised(exampleLog().frames());
  EXPECT_EQ(summary.frames, 4u);
  EXPECT_TRUE(summary.firstLeftOut);
  ASSERT_EQ(summary.passes.size(), 2u);
  EXPECT_DOUBLE_EQ(summary.passes[0].gpu.mean, 3);
  EXPECT_DOUBLE_EQ(summary.passes[0].gpu.median, 2.5);
  EXPECT_DOUBLE_EQ(summary.passes[0].draws, 4);
  EXPECT_DOUBLE_EQ(summary.passes[1].gpu.mean, 2);
  EXPECT_DOUBLE_EQ(summary.passes[1].gpu.median, 0);
  EXPECT_DOUBLE_EQ(summary.passes[1].draws, 1);
  EXPECT_DOUBLE_EQ(summary.frame.gpu.mean, 5);
  EXPECT_DOUBLE_EQ(summary.frame.gpu.median, 4.5);
}

TEST(ProfileReport, NothingMeasuredIsNothingToSumUp) {
  EXPECT_EQ(summarised({}).frames, 0u);
  EXPECT_TRUE(summarised({}).passes.empty());
}

TEST(ProfileReport, MarkdownIsATableWhoseNamesCannotBreakIt) {
  EXPECT_THAT(
      profileMarkdown(exampleLog()),
      AllOf(HasSubstr("a\\<b\\>, pipeline deferred, 64 x 36 pixels, 4 frames after the"),
            HasSubstr("| Ao\\|\\<b\\> | 0.30 | 0.25 | 3.00 | 2.50 | 4 | 0 | 1.0 | "
                      "████████████████████ |\n"),
            HasSubstr("| Once | 0.20 | 0.00 | 2.00 | 0.00 | 1 | 0 | 1.0 | █████████████▍ |\n"),
            HasSubstr("| **whole frame** | 0.00 | 0.00 | 5.00 | 4.50 |")));
}

TEST(ProfileReport, HtmlHasTheTableAndABarForEveryPassAndFrame) {
  const std::string page = profileHtml(exampleLog());
  EXPECT_THAT(page, AllOf(HasSubstr("Ao|&lt;b&gt;</td><td>0.30</td><td>0.25</td><td>3.00</td>"),
                          HasSubstr("<title>Once: GPU 2.000 ms, median 0.000 ms</title>"),
                          HasSubstr("<title>frame 2: Once 8.000 ms</title>"),
                          HasSubstr("<title>frame 3: Ao|&lt;b&gt; 6.000 ms</title>"),
                          Not(HasSubstr("frame 0"))));
}

TEST(ProfileReport, SaysWhatWasDrawn) {
  const auto text = [](int eyes, uvec2 rendered, int tile) {
    ProfileLog log({.size = {640, 360}, .plan = planViews(rendered, eyes, tile, 0)});
    log.add(frame(0, {step("Ao", 0, 1)}));
    const std::string page = profileMarkdown(log);
    EXPECT_THAT(profileHtml(log), HasSubstr(log.subject().sizeText()));
    EXPECT_THAT(page, HasSubstr(log.subject().sizeText()));
    return log.subject().sizeText();
  };
  EXPECT_EQ(text(1, {640, 360}, 0), "640 x 360 pixels");
  EXPECT_EQ(text(1, {1280, 720}, 0), "640 x 360 pixels, rendered at 1280 x 720");
  EXPECT_EQ(text(2, {640, 360}, 0), "2 eyes of 640 x 360 pixels");
  EXPECT_EQ(text(1, {640, 360}, 128), "640 x 360 pixels, in 15 tiles drawn at 128 x 136");
  EXPECT_EQ(text(2, {320, 180}, 128),
            "2 eyes of 640 x 360 pixels, rendered at 320 x 180, in 6 tiles drawn at 128 x 132");
}

TEST(ProfileReport, ViewsAreToldApart) {
  ProfileLog log;
  log.add(frame(0, {step("Ao", 0, 1), step("Ao", 1, 2)}));
  EXPECT_THAT(profileMarkdown(log),
              AllOf(HasSubstr("| Ao, view 0 |"), HasSubstr("| Ao, view 1 |")));
}

// 1000 frames in 334 columns of three.
TEST(ProfileReport, ManyFramesShareColumns) {
  ProfileLog log;
  for (std::uint64_t f = 0; f <= 1000; ++f)
    log.add(frame(f, {step("Ao", 0, static_cast<double>(f % 3))}));
  const std::string page = profileHtml(log);
  EXPECT_THAT(page, AllOf(HasSubstr("<title>frames 1 to 3, mean: Ao 1.000 ms</title>"),
                          HasSubstr("<title>frame 1000: Ao 1.000 ms</title>")));
}

}  // namespace
}  // namespace lucerna::app
