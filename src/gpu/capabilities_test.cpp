#include "gpu/capabilities.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/file.hpp"
#include "core/log.hpp"
#include "gpu/workarounds.hpp"

namespace lucerna::gpu {
namespace {

using testing::HasSubstr;

std::string faultIn(const std::string& text) {
  const auto result = Capabilities::fromJson(text, "caps.json");
  if (result) return "no fault";
  EXPECT_EQ(result.error().kind, ErrorKind::Input);
  EXPECT_THAT(result.error().message, HasSubstr("caps.json"));
  return result.error().message;
}

TEST(Capabilities, BaselineIsOpenGl45) {
  const Capabilities caps = Capabilities::baseline();
  EXPECT_TRUE(caps.features.contains(kFeatureCompute));
  EXPECT_FALSE(caps.features.contains(kFeatureLayeredVertex));
  EXPECT_TRUE(caps.renderable.contains(Format::Rgba16Float));
  EXPECT_FALSE(caps.renderable.contains(Format::Rgb9E5));
}

TEST(Capabilities, SurviveJson) {
  Capabilities caps = Capabilities::baseline();
  caps.maxSamples = 2;
  caps.maxTextureLayers = 3000;
  caps.softwareRasterizer = true;
  const auto back = Capabilities::fromJson(caps.toJson(), "memory");
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_EQ(back->name, caps.name);
  EXPECT_EQ(back->features, caps.features);
  EXPECT_EQ(back->renderable, caps.renderable);
  EXPECT_EQ(back->maxSamples, 2);
  EXPECT_EQ(back->maxTextureLayers, 3000);
  EXPECT_TRUE(back->softwareRasterizer);
}

TEST(Capabilities, LimitsAndNameMayBeMissing) {
  const auto caps = Capabilities::fromJson(R"({"features": [], "renderable": ["R8Unorm"]})", "x");
  ASSERT_TRUE(caps) << caps.error().message;
  EXPECT_EQ(caps->name, "x");
  EXPECT_EQ(caps->maxColorTargets, 8);
  EXPECT_EQ(caps->renderable, std::set{Format::R8Unorm});
}

TEST(Capabilities, FaultsAreNamed) {
  EXPECT_THAT(faultIn("{"), HasSubstr("is no JSON"));
  EXPECT_THAT(faultIn("[]"), HasSubstr("found [], wanted an object"));
  EXPECT_THAT(faultIn(R"({"renderable": []})"), HasSubstr("found no \"features\", wanted a list"));
  EXPECT_THAT(faultIn(R"({"features": ["computer"], "renderable": []})"),
              HasSubstr("did you mean 'compute'"));
  EXPECT_THAT(faultIn(R"({"features": [], "renderable": ["Rgba16"]})"), HasSubstr("\"Rgba16\""));
  EXPECT_THAT(faultIn(R"({"features": [], "renderable": [], "maxSample": 4})"),
              HasSubstr("did you mean 'maxSamples'"));
  EXPECT_THAT(faultIn(R"({"features": [], "renderable": [], "maxSamples": 1.5})"),
              HasSubstr("found 1.5, wanted a whole number from 1 to"));
  EXPECT_THAT(faultIn(R"({"features": 3, "renderable": [], "maxSamples": 0, "name": 3})"),
              testing::AllOf(HasSubstr("caps.json:1: /features: found 3"), HasSubstr("/maxSamples"),
                             HasSubstr("/name")));
}

TEST(Capabilities, AreFoundInWhatDoctorPrints) {
  const auto caps = Capabilities::fromJson(
      R"({"version": "0.1", "gl": {"features": [], "renderable": ["R8Unorm"], "maxSamples": 2}})",
      "doctor.json");
  ASSERT_TRUE(caps) << caps.error().message;
  EXPECT_EQ(caps->maxSamples, 2);
  EXPECT_THAT(faultIn(R"({"gl": {"features": []}})"), HasSubstr("/gl: found no \"renderable\""));
}

TEST(Workarounds, FollowTheDriverAndCanBeSwitchedOff) {
  using testing::ElementsAre;
  Capabilities caps = Capabilities::baseline();
  EXPECT_THAT(workaroundsFor(caps, ""), ElementsAre("keep-discarded-layers"));
  caps.softwareRasterizer = true;
  EXPECT_THAT(workaroundsFor(caps, ""),
              ElementsAre("keep-discarded-layers", "no-anisotropy", "timers-on-cpu-clock"));
  EXPECT_THAT(workaroundsFor(caps, "no-anisotropy,keep-discarded-layers"),
              ElementsAre("timers-on-cpu-clock"));
  const int warnings = log::warningCount();
  caps.softwareRasterizer = false;
  caps.name = "NVIDIA GeForce RTX 4070/PCIe/SSE2";
  EXPECT_THAT(workaroundsFor(caps, ""),
              ElementsAre("keep-discarded-layers", "no-performance-messages"));
  workaroundsFor(caps, "timers-on-cpu-clock");  // known, though not needed here
  EXPECT_EQ(log::warningCount(), warnings);
  workaroundsFor(caps, "timers-on-gpu-clock");
  EXPECT_EQ(log::warningCount(), warnings + 1);
}

TEST(Capabilities, Es3FileIsReadable) {
  const std::string path = LUCERNA_SOURCE_DIR "/docs/dev/es3.json";
  const auto text = readText(path);
  ASSERT_TRUE(text) << text.error().message;
  const auto caps = Capabilities::fromJson(*text, path);
  ASSERT_TRUE(caps) << caps.error().message;
  EXPECT_FALSE(caps->features.contains(kFeatureCompute));
  EXPECT_FALSE(caps->renderable.contains(Format::Rg16Unorm));
  EXPECT_EQ(caps->maxColorTargets, 4);
}

}  // namespace
}  // namespace lucerna::gpu
