#include "gpu/gl.hpp"
#include "gpu/gl_test_fixture.hpp"
#include "gpu/workarounds.hpp"

namespace lucerna::gpu {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using DeviceGlTest = GlTest;

TEST_F(DeviceGlTest, DescribesItself) {
  EXPECT_THAT(device().description(), HasSubstr(" | "));
  EXPECT_THAT(device().description(), HasSubstr(device().capabilities().name));
  const Capabilities baseline = Capabilities::baseline();
  for (const std::string& feature : baseline.features)
    EXPECT_TRUE(device().capabilities().features.contains(feature)) << feature;
  EXPECT_GE(device().capabilities().maxTextureSide, 16384);
  EXPECT_GE(device().capabilities().maxTextureLayers, 2048);
  const bool inForce = device().description().find(kTimersOnCpuClock) != std::string::npos;
  EXPECT_EQ(device().timersUseCpuClock(), inForce);
}

TEST_F(DeviceGlTest, TimersNestAndComeInOrder) {
  const Texture color = target(Format::Rgba32Float, 512, 512);
  static constexpr EmbeddedShader kShader{
      "test/slow.frag",
      "layout(location = 0) in vec2 uv;\nlayout(location = 0) out vec4 color;\nvoid main() {\n"
      "  vec2 p = uv;\n  for (int i = 0; i < 64; ++i) p = sin(p + uv.yx);\n"
      "  color = vec4(p, 0.0, 1.0);\n}\n"};
  const ProgramPtr program = fragment(kShader);
  const auto render = [&] {
    Rendering draw = device().render({.colors = {{&color, Load::Discard}}});
    draw.use(*program, {});
    draw.fullscreen();
  };
  render();  // compiles
  device().beginTimer("frame");
  device().beginTimer("slow");
  render();
  device().endTimer();
  device().beginTimer("empty");
  device().endTimer();
  device().endTimer();
  const auto times = device().takeTimes();
  ASSERT_EQ(times.size(), 3u);
  EXPECT_EQ(times[0].first, "frame");
  EXPECT_EQ(times[1].first, "slow");
  EXPECT_EQ(times[2].first, "empty");
  EXPECT_GT(times[1].second, 0.0);
  EXPECT_GT(times[1].second, times[2].second);
  EXPECT_GE(times[0].second, times[1].second);
  EXPECT_TRUE(device().takeTimes().empty());
}

TEST_F(DeviceGlTest, DebugMessagesNameTheGroup) {
  {
    const DebugGroup outer(device(), "Lighting");
    const DebugGroup inner(device(), "tiles");
    glBindTextureUnit(0, 123456);  // no such texture
  }
  const std::vector<std::string> messages = device().takeDebugMessages();
  ASSERT_EQ(messages.size(), 1u);
  EXPECT_THAT(messages[0], HasSubstr("Lighting / tiles: "));
}

TEST_F(DeviceGlTest, BuffersUpdateGrowAndCount) {
  const std::vector<std::uint8_t> four = {1, 2, 3, 4}, two = {8, 9}, eight(8, 7);
  Buffer buffer = device().createBuffer(bytesOf(four), "buffer");
  device().update(buffer, bytesOf(two), 1);
  EXPECT_THAT(device().download(buffer),
              ElementsAre(std::byte{1}, std::byte{8}, std::byte{9}, std::byte{4}));
  EXPECT_EQ(device().counters().uploads, 6u);
  const std::uint32_t id = buffer.id();
  device().write(buffer, bytesOf(two), "buffer");
  EXPECT_EQ(buffer.id(), id);
  device().write(buffer, bytesOf(eight), "buffer");
  EXPECT_GE(buffer.bytes(), 8u);
  EXPECT_EQ(device().objectCounts().buffers, 1);
  EXPECT_EQ(device().objectCounts().bufferBytes, buffer.bytes());
  device().resetCounters();
  EXPECT_EQ(device().counters().uploads, 0u);
  EXPECT_EQ(device().createBuffer(std::size_t{0}, "empty").bytes(), 4u);
}

TEST_F(DeviceGlTest, OneScopeAtATime) {
  const Texture color = target(Format::R8Unorm);
  const Rendering open = device().render({.colors = {{&color}}});
  EXPECT_DEATH(device().compute(), "one at a time");
}

TEST(ContextGlTest, TwoLivesInOneProcess) {
  for (int i = 0; i < 2; ++i) {
    auto context = Context::create();
    ASSERT_TRUE(context) << context.error().message;
    EXPECT_THAT((*context)->platform(), HasSubstr("EGL"));
    auto created = Device::create(**context);
    ASSERT_TRUE(created) << created.error().message;
  }
}

TEST(ContextGlTest, ADeviceDoesNotOutliveItsTextures) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  auto context = Context::create();
  ASSERT_TRUE(context);
  auto created = Device::create(**context);
  ASSERT_TRUE(created);
  std::unique_ptr<Device> device = std::move(*created);
  const Texture texture = device->createTexture({}, "late");
  EXPECT_DEATH(device.reset(), "1 textures");
}

}  // namespace
}  // namespace lucerna::gpu
