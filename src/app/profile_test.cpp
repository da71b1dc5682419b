#include "app/profile.hpp"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

namespace lucerna::app {
namespace {

using testing::HasSubstr;

ProfileLog exampleLog() {
  ProfileLog log({.gpuClock = "cpu-after-finish"});
  for (std::uint64_t frame = 0; frame < 3; ++frame) {
    graph::StepProfile step;
    step.row = "Ao, wide";
    step.cpuMs = 1 + static_cast<double>(frame);
    step.gpuMs = 10 * step.cpuMs;
    step.counters.draws = 2;
    step.counters.primitives = 7;
    step.textureBytes = 1 << 20;
    log.add({.frame = frame,
             .steps = {step},
             .cpuMs = step.cpuMs,
             .gpuMs = step.gpuMs,
             .counters = step.counters,
             .textureBytes = 3 << 20});
  }
  return log;
}

TEST(Profile, CsvHasARowForEveryPassAndOneForTheFrame) {
  EXPECT_EQ(exampleLog().csv(),
            "frame,pass,view,cpu_ms,gpu_ms,draws,primitives,texture_bytes,gpu_clock\n"
            "0,\"Ao, wide\",0,1.0000,10.0000,2,7,1048576,cpu-after-finish\n"
            "0,(frame),,1.0000,10.0000,2,7,3145728,cpu-after-finish\n"
            "1,\"Ao, wide\",0,2.0000,20.0000,2,7,1048576,cpu-after-finish\n"
            "1,(frame),,2.0000,20.0000,2,7,3145728,cpu-after-finish\n"
            "2,\"Ao, wide\",0,3.0000,30.0000,2,7,1048576,cpu-after-finish\n"
            "2,(frame),,3.0000,30.0000,2,7,3145728,cpu-after-finish\n");
}

TEST(Profile, JsonHasTheSameCostsOfPassesAndFrames) {
  const auto json = nlohmann::json::parse(exampleLog().json());
  EXPECT_EQ(json["gpu_clock"], "cpu-after-finish");
  const auto& frame = json["frames"][1];
  EXPECT_EQ(frame["frame"], 1);
  EXPECT_EQ(frame["passes"][0]["pass"], "Ao, wide");
  for (const nlohmann::json& cost : {frame, frame["passes"][0]}) {
    EXPECT_EQ(cost["cpu_ms"], 2);
    EXPECT_EQ(cost["gpu_ms"], 20);
    EXPECT_EQ(cost["draws"], 2);
    EXPECT_EQ(cost["primitives"], 7);
  }
  EXPECT_EQ(frame["texture_bytes"], 3 << 20);
  EXPECT_EQ(frame["passes"][0]["texture_bytes"], 1 << 20);
}

// Frames 1 and 2 of three: 2.5 and 25 ms.
TEST(Profile, TheTableLeavesTheFirstFrameOut) {
  EXPECT_THAT(exampleLog().table(), HasSubstr("2.50"));
  EXPECT_THAT(exampleLog().table(), HasSubstr("25.00"));
  EXPECT_THAT(exampleLog().table(), HasSubstr("mean of 2 frames (the first left out)"));
}

TEST(Profile, TheExtensionChoosesTheForm) {
  for (const char* path : {"a.csv", "a.json", "a.md", "a.html"})
    EXPECT_TRUE(ProfileLog::checkPath(path)) << path;
  EXPECT_EQ(ProfileLog::checkPath("a.txt").error().kind, ErrorKind::Usage);
}

}  // namespace
}  // namespace lucerna::app
