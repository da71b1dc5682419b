// A device for tests that need a driver: it checks after each test that OpenGL had no complaint and
// that no object was left behind.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gpu/context.hpp"
#include "gpu/device.hpp"

namespace lucerna::gpu {

class GlTest : public testing::Test {
 protected:
  void SetUp() override {
    GTEST_FLAG_SET(death_test_style, "threadsafe");  // drivers have threads, fork() alone is unsafe
    auto context = Context::create();
    ASSERT_TRUE(context) << context.error().message;
    context_ = std::move(*context);
    auto created = Device::create(*context_);
    ASSERT_TRUE(created) << created.error().message;
    device_ = std::move(*created);
  }

  void TearDown() override {
    if (!device_) return;
    EXPECT_THAT(device_->takeDebugMessages(), testing::IsEmpty());
    for (const Error& error : device_->takeErrors()) ADD_FAILURE() << error.message;
    const ObjectCounts counts = device_->objectCounts();
    EXPECT_EQ(counts.textures, 0);
    EXPECT_EQ(counts.textureBytes, 0u);
    EXPECT_EQ(counts.buffers, 0);
    EXPECT_EQ(counts.bufferBytes, 0u);
    EXPECT_EQ(counts.vertexInputs, 0);
    EXPECT_EQ(counts.framebuffers, 0);
    EXPECT_EQ(counts.queries, 0);
    device_.reset();
    context_.reset();
  }

  Device& device() { return *device_; }

  // A program of the fullscreen vertex shader and this fragment shader's text, which must outlive
  // the test.
  ProgramPtr fragment(const EmbeddedShader& shader) {
    device().shaderSources().add({&shader, 1});
    return device().program(
        {.vertex = "gpu/fullscreen.vert", .fragment = std::string(shader.path)});
  }

  Texture target(Format format, int width = 4, int height = 4) {
    return device().createTexture({.format = format, .width = width, .height = height},
                                  std::string(info(format).name));
  }

  // The first pixel of the lowest row as F32.
  vec4 firstPixel(const Texture& texture) {
    const Image image = converted(device().download(texture, 0, false), ComponentType::F32, 4);
    return glm::make_vec4(image.as<float>().data());
  }

 private:
  std::unique_ptr<Context> context_;
  std::unique_ptr<Device> device_;
};

template <typename T>
std::span<const std::byte> bytesOf(const std::vector<T>& values) {
  return std::as_bytes(std::span(values));
}

}  // namespace lucerna::gpu
