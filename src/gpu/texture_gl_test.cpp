#include <cmath>

#include "gpu/gl_test_fixture.hpp"

namespace lucerna::gpu {
namespace {

using TextureGlTest = GlTest;

// A clear value, and what one component of it becomes in the format.
struct Expected {
  vec4 clear;
  vec4 stored;
  float tolerance;
};

Expected expected(const FormatInfo& format) {
  if (format.kind == FormatClass::Depth) return {vec4(0.25f), vec4(0.25f), 1e-6f};
  if (format.kind == FormatClass::Uint || format.kind == FormatClass::Int)
    return {{3.f, 7.f, 200.f, 255.f}, {3.f, 7.f, 200.f, 255.f}, 0.f};
  const vec4 value(0.2f, 0.5f, 0.75f, 1.f);
  if (format.format == Format::Srgb8Alpha8)
    return {value,
            {srgbFromLinear(0.2f), srgbFromLinear(0.5f), srgbFromLinear(0.75f), 1.f},
            0.5f / 255};
  const float step = format.kind == FormatClass::Unorm
                         ? (format.bytes == format.channels ? 255.f : 65535.f)
                         : 64.f;
  return {value, value, 0.51f / step};
}

// Component `channel` of the first pixel, whatever the type.
float component(const Image& image, const FormatInfo& format, int channel) {
  const auto index = static_cast<std::size_t>(channel);
  const bool integer = format.kind == FormatClass::Uint || format.kind == FormatClass::Int;
  switch (image.type()) {
    case ComponentType::U8:
      return static_cast<float>(image.as<std::uint8_t>()[index]) / (integer ? 1.f : 255.f);
    case ComponentType::U16:
      return static_cast<float>(image.as<std::uint16_t>()[index]) / (integer ? 1.f : 65535.f);
    case ComponentType::Half:
      return floatFromHalf(image.as<std::uint16_t>()[index]);
    case ComponentType::F32:
      break;
  }
  return integer ? static_cast<float>(image.as<std::uint32_t>()[index]) : image.as<float>()[index];
}

void expectPixel(const Image& image, const FormatInfo& format, const Expected& want,
                 const char* how) {
  for (int c = 0; c < format.channels; ++c)
    EXPECT_NEAR(component(image, format, c), want.stored[c], want.tolerance)
        << how << " " << format.name << " channel " << c;
}

TEST_F(TextureGlTest, EveryRenderableFormatClearsAndDownloads) {
  for (const FormatInfo& format : allFormats()) {
    if (!format.renderable) continue;
    EXPECT_TRUE(device().capabilities().renderable.contains(format.format)) << format.name;
    const Expected want = expected(format);
    const Texture drawn = target(format.format, 5, 3);
    const Texture cleared = target(format.format, 5, 3);
    if (format.kind == FormatClass::Depth)
      device().render({.depth = {&drawn, Load::Clear, want.clear.x}});
    else
      device().render({.colors = {{&drawn, Load::Clear, want.clear}}});
    device().clear(cleared, want.clear);
    const Image image = device().download(drawn);
    EXPECT_EQ(image.width(), 5);
    EXPECT_EQ(image.height(), 3);
    EXPECT_EQ(image.channels(), format.channels);
    expectPixel(image, format, want, "render");
    expectPixel(device().download(cleared), format, want, "clear");
  }
}

TEST_F(TextureGlTest, ClearReachesRgb9E5) {
  const Texture texture = target(Format::Rgb9E5);
  device().clear(texture, vec4(0.5f, 2.f, 8.f, 1.f));
  const Image image = device().download(texture);
  EXPECT_EQ(image.channels(), 3);
  EXPECT_EQ(image.as<float>()[2], 8.f);
}

TEST_F(TextureGlTest, EveryColourFormatReturnsWhatWasUploaded) {
  for (const FormatInfo& format : allFormats()) {
    if (format.format == Format::Depth24 || format.format == Format::Depth32FStencil8) continue;
    const Texture texture = target(format.format, 3, 2);
    device().clear(texture, vec4(0.f));
    Image image = device().download(texture);  // its type and channels are those of the format
    if (image.type() == ComponentType::F32) {
      float value = 0.f;
      for (float& component : image.as<float>()) component = value += 0.125f;
    } else if (bytesPer(image.type()) == 2) {
      std::uint16_t value = 0x3000;
      for (std::uint16_t& component : image.as<std::uint16_t>()) component = value += 0x11;
    } else {
      std::uint8_t value = 0;
      for (std::uint8_t& component : image.as<std::uint8_t>()) component = value += 9;
    }
    device().upload(texture, image);
    const Image back = device().download(texture, 0, false);
    const auto same = std::ranges::equal(image.bytes(), back.bytes());
    // Six and five bits of mantissa, and a shared exponent: near, not equal.
    if (format.format == Format::R11G11B10Float || format.format == Format::Rgb9E5) {
      for (std::size_t i = 0; i < image.as<float>().size(); ++i)
        EXPECT_NEAR(image.as<float>()[i], back.as<float>()[i], 0.04f) << format.name;
    } else {
      EXPECT_TRUE(same) << format.name;
    }
  }
}

TEST_F(TextureGlTest, ThreeChannelsUploadWithOpaqueAlpha) {
  const Texture texture = target(Format::Srgb8Alpha8, 3, 1);  // rows of nine bytes
  Image image(3, 1, 3, ComponentType::U8);
  for (std::uint8_t i = 0; i < 9; ++i) image.as<std::uint8_t>()[i] = i;
  device().upload(texture, image);
  const Image back = device().download(texture, 0, false);
  EXPECT_THAT(back.as<std::uint8_t>(),
              testing::ElementsAre(0, 1, 2, 255, 3, 4, 5, 255, 6, 7, 8, 255));
}

TEST_F(TextureGlTest, LayersAndFacesAreSeparate) {
  for (const TextureKind kind : {TextureKind::Array2D, TextureKind::Cube}) {
    const Texture texture = device().createTexture(
        {.kind = kind, .format = Format::R8Unorm, .width = 2, .height = 2, .layers = 6}, "layers");
    for (int layer = 0; layer < 6; ++layer) {
      if (layer % 2 == 0) {
        Image image(2, 2, 1, ComponentType::U8);
        std::ranges::fill(image.as<std::uint8_t>(), static_cast<std::uint8_t>(10 * layer));
        device().upload(texture, image, layer);
      } else {
        const float value = static_cast<float>(10 * layer) / 255.f;
        device().render({.colors = {{&texture, Load::Clear, vec4(value), layer}}});
      }
    }
    device().render({.colors = {{&texture, Load::Discard, vec4(0.f), 3}}});
    for (const int layer : {0, 1, 2, 4, 5})
      EXPECT_EQ(device().download(texture, layer).as<std::uint8_t>()[0], 10 * layer);
    device().render({.colors = {{&texture, Load::Clear, vec4(1.f)}}});  // all layers at once
    for (int layer = 0; layer < 6; ++layer)
      EXPECT_EQ(device().download(texture, layer).as<std::uint8_t>()[3], 255);
  }
}

TEST_F(TextureGlTest, MipmapsOfSrgbAverageLight) {
  const Texture texture = device().createTexture(
      {.format = Format::Srgb8Alpha8, .width = 2, .height = 2, .levels = 0}, "mip");
  EXPECT_EQ(texture.desc().levels, 2);
  Image image(2, 2, 4, ComponentType::U8);
  const std::uint8_t texels[16] = {0,   0,   0,   255, 255, 255, 255, 255,
                                   255, 255, 255, 255, 0,   0,   0,   255};
  std::ranges::copy(texels, image.as<std::uint8_t>().begin());
  device().upload(texture, image);
  device().generateMipmaps(texture);
  const Texture result = target(Format::Rgba32Float, 1, 1);
  static constexpr EmbeddedShader kShader{
      "test/mip.frag",
      "uniform sampler2D source;\nlayout(location = 0) out vec4 color;\n"
      "void main() { color = textureLod(source, vec2(0.5), 1.0); }\n"};
  const ProgramPtr program = fragment(kShader);
  {
    Rendering draw = device().render({.colors = {{&result, Load::Discard}}});
    draw.use(*program, {});
    draw.texture("source", texture, {.filter = Filter::Trilinear});
    draw.fullscreen();
  }
  EXPECT_NEAR(firstPixel(result).x, 0.5f, 0.01f);  // not the 0.21 of averaged bytes
}

TEST_F(TextureGlTest, CopyAndFlip) {
  const Texture from = target(Format::R8Unorm, 1, 2);
  const Texture to = target(Format::R8Unorm, 1, 2);
  Image image(1, 2, 1, ComponentType::U8);
  image.as<std::uint8_t>()[0] = 1;
  image.as<std::uint8_t>()[1] = 2;
  device().upload(from, image);
  device().copy(from, to);
  EXPECT_THAT(device().download(to, 0, false).as<std::uint8_t>(), testing::ElementsAre(1, 2));
  EXPECT_THAT(device().download(to).as<std::uint8_t>(), testing::ElementsAre(2, 1));
}

TEST_F(TextureGlTest, ClearAndCopyReachAllLevels) {
  const TextureDesc desc{.format = Format::R32Float, .width = 4, .height = 4, .levels = 0};
  const Texture from = device().createTexture(desc, "from"),
                to = device().createTexture(desc, "to");
  device().clear(from, vec4(0.25f));
  device().clear(to, vec4(0.75f));
  device().copy(from, to);
  static constexpr EmbeddedShader kShader{
      "test/levels.frag",
      "uniform sampler2D source;\nlayout(location = 0) out vec4 color;\n"
      "void main() { color = vec4(texelFetch(source, ivec2(0), 0).r,\n"
      "  texelFetch(source, ivec2(0), 1).r, texelFetch(source, ivec2(0), 2).r, 1.0); }\n"};
  const ProgramPtr program = fragment(kShader);
  const Texture result = target(Format::Rgba32Float, 1, 1);
  {
    Rendering draw = device().render({.colors = {{&result, Load::Discard}}});
    draw.use(*program, {});
    draw.texture("source", to, {.filter = Filter::Trilinear});
    draw.fullscreen();
  }
  EXPECT_EQ(firstPixel(result), vec4(0.25f, 0.25f, 0.25f, 1.f));
}

TEST_F(TextureGlTest, WhatTheDriverHasNoMemoryForSaysWhatToDo) {
  const TextureDesc desc{.kind = TextureKind::Array2D,
                         .format = Format::Rgba32Float,
                         .width = 16384,
                         .height = 16384,
                         .layers = 2048};
  try {
    device().createTexture(desc, "maps", "set Maps.size lower");
    GTEST_SKIP() << "this driver promises 8 TiB";
  } catch (const OutOfMemory& fault) {
    EXPECT_THAT(fault.what(), ::testing::HasSubstr("'maps' of 16384 x 16384 x 2048 pixels"));
    EXPECT_THAT(fault.what(), ::testing::EndsWith("; set Maps.size lower"));
  }
  EXPECT_EQ(device().objectCounts().textures, 0);
  device().takeDebugMessages();  // the driver's own word
}

TEST_F(TextureGlTest, MovesKeepCountsExact) {
  Texture a = target(Format::R8Unorm);
  const ObjectCounts one = device().objectCounts();
  EXPECT_EQ(one.textures, 1);
  EXPECT_EQ(one.textureBytes, 16u);
  Texture b = std::move(a);
  EXPECT_FALSE(a);  // NOLINT(bugprone-use-after-move): that it is empty is what is tested
  EXPECT_EQ(device().objectCounts(), one);
  a = target(Format::R8Unorm);
  a = std::move(b);  // the second one dies
  EXPECT_EQ(device().objectCounts(), one);
}

TEST_F(TextureGlTest, FramebuffersDieWithTheirTextures) {
  const Texture depth = target(Format::Depth32F);
  {
    const Texture color = target(Format::R8Unorm);
    device().render({.colors = {{&color, Load::Clear}}, .depth = {&depth}});
    device().render({.colors = {{&color}}, .depth = {&depth}});
    EXPECT_EQ(device().objectCounts().framebuffers, 1);
    device().render({.depth = {&depth, Load::Clear}});
    EXPECT_EQ(device().objectCounts().framebuffers, 2);
  }
  EXPECT_EQ(device().objectCounts().framebuffers, 1);
  // A new texture may get the dead one's name: it must not get its framebuffer or its unit.
  const Texture color = target(Format::R32Float);
  device().render({.colors = {{&color, Load::Clear, vec4(2.f)}}, .depth = {&depth}});
  EXPECT_EQ(firstPixel(color).x, 2.f);
}

}  // namespace
}  // namespace lucerna::gpu
