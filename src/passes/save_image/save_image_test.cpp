// What a row may write where, and the form of it, without a GPU.
#include <gmock/gmock.h>

#include <bit>
#include <cstdlib>
#include <filesystem>

#include "core/file.hpp"
#include "graph/validate.hpp"
#include "image/image_file.hpp"
#include "passes/register_passes.hpp"
#include "passes/save_image/saved_file.hpp"

namespace lucerna::passes {
namespace {

using gpu::Format;
using testing::HasSubstr;

SavedFile fileFor(const std::string& name) {
  auto file = SavedFile::parse(name);
  EXPECT_TRUE(file) << file.error().message;
  return std::move(file).value();
}

template <typename T>
Image imageOf(int channels, ComponentType type, const std::vector<T>& values) {
  Image image(static_cast<int>(values.size()) / channels, 1, channels, type);
  std::ranges::copy(values, image.as<T>().begin());
  return image;
}

template <typename T>
std::vector<T> valuesOf(const Image& image) {
  const auto values = image.as<T>();
  return {values.begin(), values.end()};
}

TEST(SavedFile, IsNumberedByFrameAndView) {
  EXPECT_EQ(fileFor("a-%04d.exr").at(7, 0, 1), "a-0007.exr");
  EXPECT_EQ(fileFor("a.exr").at(7, 0, 1), "a.exr");
  EXPECT_EQ(fileFor("/tmp/a-%02d.PNG").at(7, 1, 2), "/tmp/a-07-view1.PNG");
}

TEST(SavedFile, RefusesNamesItCannotWrite) {
  const auto faultOf = [](const std::string& name) {
    const auto file = SavedFile::parse(name);
    return file ? "it succeeded" : file.error().message;
  };
  EXPECT_THAT(faultOf("a.jpg"), HasSubstr("ends in '.jpg'"));
  EXPECT_THAT(faultOf(""), HasSubstr("ends in ''"));
  EXPECT_THAT(faultOf("a-%s.png"), HasSubstr("frame number"));
  EXPECT_THAT(faultOf("nowhere/a.png"), HasSubstr("folder does not exist"));
}

TEST(SavedFile, ExrHoldsEveryFormatAndThePngWhatItsBitsHold) {
  const auto holds = [](const char* name, Format format) {
    const auto formats = fileFor(name).formats();
    return std::ranges::find(formats, format) != formats.end();
  };
  EXPECT_EQ(fileFor("a.exr").formats().size(), gpu::allFormats().size());
  for (const Format format : {Format::Rgba16Float, Format::Srgb8Alpha8, Format::Rg16Unorm})
    EXPECT_TRUE(holds("a.png", format) && holds("a.hdr", format));
  EXPECT_TRUE(holds("a.png", Format::Rgba8Uint) && holds("a.png", Format::R16Uint));
  for (const Format format : {Format::Depth32F, Format::R32Uint, Format::Rgba32Uint})
    EXPECT_FALSE(holds("a.png", format) || holds("a.hdr", format));
  EXPECT_FALSE(holds("a.hdr", Format::Rgba8Uint));
}

TEST(SavedFile, ExrKeepsTheNumbers) {
  const SavedFile exr = fileFor("a.exr");
  const auto floats = [&](const Image& texels, Format format) {
    return valuesOf<float>(exr.content(texels, format));
  };
  EXPECT_EQ(floats(imageOf<std::uint8_t>(4, ComponentType::U8, {1, 17, 255, 0}), Format::Rgba8Uint),
            (std::vector<float>{1, 17, 255, 0}));
  EXPECT_EQ(floats(imageOf<std::uint8_t>(1, ComponentType::U8, {255, 51}), Format::R8Unorm),
            (std::vector<float>{1, 0.2f}));
  EXPECT_EQ(floats(imageOf<float>(1, ComponentType::F32, {0.25f, 0.f}), Format::Depth32F),
            (std::vector<float>{0.25f, 0.f}));
  const float bits = std::bit_cast<float>(std::int32_t{-70000});
  EXPECT_EQ(floats(imageOf<float>(1, ComponentType::F32, {bits}), Format::R32Int),
            (std::vector<float>{-70000}));
  EXPECT_EQ(floats(imageOf<float>(1, ComponentType::F32, {bits}), Format::R32Uint),
            (std::vector<float>{4294897296.f}));
  // sRGB colours become linear, their alpha is linear already.
  const auto srgb =
      floats(imageOf<std::uint8_t>(4, ComponentType::U8, {188, 0, 255, 51}), Format::Srgb8Alpha8);
  EXPECT_EQ(srgb, (std::vector<float>{linearFromSrgb(188 / 255.f), 0, 1, 0.2f}));
}

TEST(SavedFile, PngAndHdrHoldColorsWithoutAlpha) {
  const Image material = imageOf<std::uint8_t>(4, ComponentType::U8, {1, 17, 255, 0});
  EXPECT_EQ(valuesOf<std::uint8_t>(fileFor("a.png").content(material, Format::Rgba8Uint)),
            (std::vector<std::uint8_t>{1, 17, 255}));
  const Image normals = imageOf<std::uint16_t>(2, ComponentType::U16, {1000, 65535});
  EXPECT_EQ(valuesOf<std::uint16_t>(fileFor("a.png").content(normals, Format::Rg16Unorm)),
            (std::vector<std::uint16_t>{1000, 65535, 0}));
  const Image radiance = imageOf<float>(4, ComponentType::F32, {0.f, 0.5f, 3.f, 0.3f});
  EXPECT_EQ(valuesOf<std::uint8_t>(fileFor("a.png").content(radiance, Format::Rgba32Float)),
            (std::vector<std::uint8_t>{0, 188, 255}));
  EXPECT_EQ(valuesOf<float>(fileFor("a.hdr").content(radiance, Format::Rgba32Float)),
            (std::vector<float>{0.f, 0.5f, 3.f}));
}

// A row behind GBuffer, as `pipeline check` sees it.
std::string faultsOf(const std::string& file, const std::string& reads) {
  graph::Registry registry;
  registerPasses(registry);
  graph::Pipeline pipeline;
  for (const char* type : {"Cull", "GBuffer", "SaveImage", "TiledLighting", "ToneMap"})
    pipeline.passes.push_back({.name = type, .type = type, .reads = {}, .params = {}});
  pipeline.passes[2].params["file"] = file;
  pipeline.passes[2].reads["color"] = reads;
  return graph::validate(pipeline, registry, gpu::Capabilities::baseline()).text();
}

TEST(SaveImageRow, IsCheckedWithoutWritingAnything) {
  std::string pattern = testing::TempDir() + "lucerna-save-XXXXXX";
  const std::filesystem::path folder = mkdtemp(pattern.data());
  const std::string png = folder / "a.png";
  EXPECT_EQ(faultsOf(png, "GBuffer.albedo"), "");
  EXPECT_EQ(faultsOf(folder / "a.exr", "GBuffer.depth"), "");
  EXPECT_THAT(faultsOf(png, "GBuffer.depth"), HasSubstr("FormatMismatch"));
  EXPECT_THAT(faultsOf(folder / "a.tif", "GBuffer.depth"),
              testing::AllOf(HasSubstr("UnusableValue"), HasSubstr("parameter 'file'"),
                             HasSubstr("'.tif'")));
  EXPECT_THAT(faultsOf(folder / "no" / "a.png", "GBuffer.albedo"),
              testing::AllOf(HasSubstr("UnusableValue"), HasSubstr("make the folder first")));
  EXPECT_TRUE(std::filesystem::is_empty(folder));
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace lucerna::passes
