#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "core/file.hpp"
#include "support/testing.hpp"

namespace lucerna {
namespace {

using ::testing::HasSubstr;

class Fullscreen : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = ::testing::TempDir() + "lucerna-fullscreen-XXXXXX";
    folder_ = mkdtemp(pattern.data());
    scene_.background.color = {0.25f, 0.5f, 1.f};
  }
  void TearDown() override {
    testing::expectNoDebugMessages();
    std::filesystem::remove_all(folder_);
  }

  // Cull, Forward, Background and the row with a shader of this text.
  graph::Pipeline pipelineWith(const std::string& shader, graph::ParamValues params = {}) {
    // A name of its own: the device keeps programs by name.
    const std::filesystem::path file = folder_ / fmt::format("{}.frag", ++shaders_);
    EXPECT_TRUE(writeText(file, shader));
    graph::Pipeline pipeline = testing::rows({"Cull", "Forward", "Background", "Fullscreen"});
    params["shader"] = file.string();
    pipeline.passes.back().params = std::move(params);
    return pipeline;
  }
  vec3 drawn(const std::string& shader, graph::ParamValues params = {}) {
    return testing::centerOf(
        testing::pictureOf(scene_, pipelineWith(shader, std::move(params)), {8, 4}));
  }
  std::string failure(const std::string& shader) {
    testing::SceneRenderer renderer(scene_);
    const auto output = renderer.render(pipelineWith(shader), {8, 4});
    if (output) return "it was drawn";
    EXPECT_EQ(output.error().kind, ErrorKind::Pipeline);
    return output.error().message;
  }

  scene::Scene scene_ = testing::emptyScene();
  std::filesystem::path folder_;
  int shaders_ = 0;
};

constexpr const char* kOutput = "layout(location = 0) out vec4 made;\n";

TEST_F(Fullscreen, CopiesThePictureWithoutAShaderOfItsOwn) {
  const vec3 color = testing::centerOf(testing::pictureOf(
      scene_, testing::rows({"Cull", "Forward", "Background", "Fullscreen"}), {8, 4}));
  EXPECT_NEAR(color.x, 0.25f, 1e-3f);
  EXPECT_NEAR(color.z, 1.f, 1e-3f);
}

TEST_F(Fullscreen, UniformsTakeTheirDefaultsOrTheRowsValues) {
  const std::string shader =
      std::string(kOutput) +
      "uniform sampler2D color;\nuniform float f = 0.5;\nuniform int i = 2;\nuniform bool on;\n"
      "uniform vec2 a = vec2(1, 2);\nuniform vec3 b = vec3(3);\nuniform vec4 c;\n"
      "void main() {\n"
      "  vec3 read = texelFetch(color, ivec2(gl_FragCoord.xy), 0).rgb;\n"
      "  made = vec4(read.r + f + float(i), on ? 1.0 : 0.0, a.x + a.y + b.x + b.z + c.x + c.w, "
      "1);\n"
      "}\n";
  const vec3 defaults = drawn(shader);
  EXPECT_FLOAT_EQ(defaults.x, 2.75f);
  EXPECT_FLOAT_EQ(defaults.y, 0.f);
  EXPECT_FLOAT_EQ(defaults.z, 9.f);
  const vec3 given = drawn(shader, {{"f", 1.0},
                                    {"i", std::int64_t{4}},
                                    {"on", true},
                                    {"a", std::vector<double>{0, 0}},
                                    {"b", std::vector<double>{1, 0, 2}},
                                    {"c", std::vector<double>{8, 0, 0, 4}}});
  EXPECT_FLOAT_EQ(given.x, 5.25f);
  EXPECT_FLOAT_EQ(given.y, 1.f);
  EXPECT_FLOAT_EQ(given.z, 15.f);
}

TEST_F(Fullscreen, ReadsTheViewAndItsPlaceInThePicture) {
  const vec3 color = drawn(std::string("#include \"render/view.glsl\"\n") + kOutput +
                           "layout(location = 0) in vec2 uv;\n"
                           "void main() { made = vec4(view.size.xy, uv.x, 1); }\n");
  EXPECT_FLOAT_EQ(color.x, 8.f);
  EXPECT_FLOAT_EQ(color.y, 4.f);
  EXPECT_NEAR(color.z, 4.5f / 8.f, 1e-3f);
}

TEST_F(Fullscreen, FormatAndSizeAreTheRows) {
  const Image picture = testing::pictureOf(
      scene_,
      pipelineWith(std::string(kOutput) + "void main() { made = vec4(1, 0.5, 0, 1); }\n",
                   {{"format", std::string("Rgba8Unorm")}, {"outputScale", 0.5}}),
      {8, 4});
  EXPECT_EQ(picture.type(), ComponentType::U8);
  EXPECT_EQ(picture.width(), 4);
  EXPECT_EQ(picture.height(), 2);
  EXPECT_NEAR(picture.pixel<std::uint8_t>(1, 1)[1], 127.5, 0.5);  // either is the nearest
}

TEST_F(Fullscreen, WhatIsDiscardedIsBlack) {
  EXPECT_EQ(drawn(std::string(kOutput) + "void main() { made = vec4(1); discard; }\n"), vec3(0.f));
}

TEST_F(Fullscreen, AShaderThatDoesNotCompileSaysFileAndLine) {
  EXPECT_TRUE(writeText(folder_ / "own.glsl", "float two() { return 2.0; }\n"));
  EXPECT_THAT(failure("#include \"own.glsl\"\nvoid main() {\n  nonsense;\n}\n"),
              HasSubstr("1.frag:3: error"));
  EXPECT_TRUE(writeText(folder_ / "own.glsl", "\nfloat two() { return nonsense; }\n"));
  EXPECT_THAT(failure("#include \"own.glsl\"\nvoid main() {}\n"), HasSubstr("own.glsl:2: error"));
}

TEST_F(Fullscreen, ASamplerMadeByAMacroIsRefusedNotDrawnUnbound) {
  EXPECT_THAT(
      failure("#define DECLARE uniform sampler2D hidden;\nDECLARE\n" + std::string(kOutput) +
              "void main() { made = texelFetch(hidden, ivec2(0), 0); }\n"),
      HasSubstr("'hidden' (sampler2D) is read"));
}

}  // namespace
}  // namespace lucerna
