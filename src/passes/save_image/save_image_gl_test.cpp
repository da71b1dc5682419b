#include <gmock/gmock.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "image/image_file.hpp"
#include "support/testing.hpp"

namespace lucerna {
namespace {

constexpr uvec2 kSize{32, 18};

class SaveImageTest : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = ::testing::TempDir() + "lucerna-save-XXXXXX";
    folder_ = mkdtemp(pattern.data());
  }
  void TearDown() override {
    std::filesystem::remove_all(folder_);
    testing::expectNoDebugMessages();
  }

  // Rows with a SaveImage behind the first `place` of them.
  static graph::Pipeline withRow(std::vector<std::string> types, std::size_t place,
                                 const std::filesystem::path& file, const std::string& reads) {
    types.insert(types.begin() + static_cast<std::ptrdiff_t>(place), "SaveImage");
    graph::Pipeline pipeline = testing::rows(types);
    pipeline.output = "ToneMap.color";
    pipeline.passes[place].params["file"] = file.string();
    if (!reads.empty()) pipeline.passes[place].reads["color"] = reads;
    return pipeline;
  }

  std::filesystem::path folder_;
  scene::Scene scene_ = testing::sampleScene();
  testing::SceneRenderer renderer_{scene_};
};

TEST_F(SaveImageTest, WritesTheTexelsOfWhatItReads) {
  for (const std::string value : {"GBuffer.depth", "GBuffer.normal", "GBuffer.material"}) {
    const auto file = folder_ / (value + ".exr");
    const auto output =
        renderer_.render(withRow(testing::kDeferredRows, 2, file, value), kSize, {value});
    ASSERT_TRUE(output) << output.error().message;
    const auto layers = readExrLayers(file);
    ASSERT_TRUE(layers) << layers.error().message;
    const Image& saved = layers->at(0).image;
    const Image& texels = output->kept.at(value);
    const bool integers = value == "GBuffer.material";
    const Image wanted = converted(texels, ComponentType::F32, texels.channels());
    ASSERT_EQ(saved.channels(), texels.channels()) << value;
    for (std::size_t i = 0; i < wanted.as<float>().size(); ++i)
      ASSERT_EQ(saved.as<float>()[i],
                integers ? static_cast<float>(texels.as<std::uint8_t>()[i]) : wanted.as<float>()[i])
          << value << ", component " << i;
  }
}

// Before the background is drawn and after it: the same port, another picture.
TEST_F(SaveImageTest, WritesThePictureAsItIsAtItsPlace) {
  scene_.background.color = vec3(0.5f);
  const auto at = [&](std::size_t place, const char* name) {
    const auto output =
        renderer_.render(withRow(testing::kDeferredRows, place, folder_ / name, ""), kSize);
    EXPECT_TRUE(output) << output.error().message;
    return readImage(folder_ / name).value();
  };
  const auto behind = [](const char* type) {
    const auto& types = testing::kDeferredRows;
    return static_cast<std::size_t>(std::ranges::find(types, type) - types.begin()) + 1;
  };
  const Image lit = at(behind("TiledLighting"), "lit.exr");
  const Image withBackground = at(behind("Background"), "background.exr");
  EXPECT_FALSE(std::ranges::equal(lit.bytes(), withBackground.bytes()));
  EXPECT_EQ(lit.pixel<float>(0, 0)[0], 0.f);
  EXPECT_EQ(withBackground.pixel<float>(0, 0)[0], 0.5f);
  const Image picture = at(behind("ToneMap"), "toned.png");
  const auto output = renderer_.render(testing::rows(testing::kDeferredRows), kSize);
  EXPECT_TRUE(std::ranges::equal(picture.bytes(),
                                 converted(output->picture, ComponentType::U8, 3).bytes()));
}

TEST_F(SaveImageTest, AFileThatCannotBeWrittenEndsTheRenderingWithItsName) {
  const auto output = renderer_.render(
      withRow(testing::kDeferredRows, 2, "/proc/lucerna.png", "GBuffer.albedo"), kSize);
  ASSERT_FALSE(output);
  EXPECT_EQ(output.error().kind, ErrorKind::Failed);
  EXPECT_THAT(output.error().message, ::testing::HasSubstr("/proc/lucerna.png: cannot be written"));
}

}  // namespace
}  // namespace lucerna
