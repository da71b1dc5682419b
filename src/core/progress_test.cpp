#include "core/progress.hpp"

#include <gmock/gmock.h>

#include <thread>

namespace lucerna {
namespace {

TEST(Progress, ShortWorkAndHiddenWorkPrintNothing) {
  testing::internal::CaptureStderr();
  {
    Progress quick("quick", 10);
    for (int i = 0; i < 10; ++i) quick.advance();
  }
  Progress::setVisible(false);
  {
    Progress hidden("hidden", 10);
    hidden.advance(10);
  }
  Progress::setVisible(true);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(Progress, PrintsALineEveryFiveSecondsWithoutATerminal) {
  testing::internal::CaptureStderr();
  {
    Progress slow("slow", 4), counting("counting", 4, "rays");
    slow.advance(1);
    std::this_thread::sleep_for(std::chrono::milliseconds(5050));
    slow.advance(1);
    slow.advance(1);
    counting.advance(2, 60'000'000);
    counting.advance(1);
  }
  EXPECT_THAT(testing::internal::GetCapturedStderr(),
              testing::MatchesRegex("slow:  50 %  ETA 0:05\n"
                                    "counting:  50 %  ETA 0:05  11[.][0-9] million rays/s\n"));
}

}  // namespace
}  // namespace lucerna
