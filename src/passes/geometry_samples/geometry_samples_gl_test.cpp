// What the samples hold is tested by what Sraa makes of it.
#include <gtest/gtest.h>

#include "support/testing.hpp"

namespace lucerna {
namespace {

gpu::Counters countersOf(const graph::FrameProfile& profile, const std::string& row) {
  for (const graph::StepProfile& step : profile.steps)
    if (step.row == row) return step.counters;
  ADD_FAILURE() << row << " did not run";
  return {};
}

TEST(GeometrySamples, DrawsWhatGBufferDraws) {
  const scene::Scene scene = testing::sampleScene();
  testing::SceneRenderer renderer(scene);
  renderer.profiling = true;
  const auto output = renderer.render(
      testing::rows({"Cull", "GBuffer", "TiledLighting", "ToneMap", "GeometrySamples", "Sraa"}),
      {64, 36});
  ASSERT_TRUE(output) << output.error().message;
  const gpu::Counters expected = countersOf(output->profile, "GBuffer");
  const gpu::Counters found = countersOf(output->profile, "GeometrySamples");
  EXPECT_GT(expected.draws, 0u);
  EXPECT_EQ(found.draws, expected.draws);
  EXPECT_EQ(found.primitives, expected.primitives);
  testing::expectNoDebugMessages();
}

TEST(GeometrySamples, StoresNormalsOnlyIfAsked) {
  const graph::PassType& type = *testing::registry().find("GeometrySamples");
  EXPECT_TRUE(type.describe({}).output("normalSamples"));
  EXPECT_FALSE(type.describe({{"geometry", std::string("depth")}}).output("normalSamples"));
}

}  // namespace
}  // namespace lucerna
