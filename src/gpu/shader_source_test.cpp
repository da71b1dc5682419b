#include "gpu/shader_source.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <fstream>

#include "core/file.hpp"
#include "core/test_folder.hpp"

namespace lucerna::gpu {

std::span<const EmbeddedShader> embeddedShaders_gpu_test();

namespace {

using testing::ElementsAre;
using testing::HasSubstr;
namespace fs = std::filesystem;

constexpr EmbeddedShader kShaders[] = {
    {"a/main.frag",
     "// first\n#include \"a/one.glsl\"\n  # include  \"a/two.glsl\"\nvoid main() {}\n"},
    {"a/one.glsl", "#include \"a/two.glsl\"\nint one;\n"},
    {"a/two.glsl", "#include \"a/one.glsl\"\nint two;"},
    {"a/missing.frag", "\n#include \"a/tow.glsl\"\n"},
    {"a/version.frag", "#version 330\n"},
    {"a/unquoted.frag", "#include <a/one.glsl>\n"},
};

ShaderSources sources() {
  ShaderSources result;
  result.add(kShaders);
  return result;
}

TEST(ShaderSources, ExpandsEachFileOnceAndMapsLines) {
  const auto shader = sources().expand("a/main.frag", {{"TAPS", "4"}, {"SHADOWS", ""}});
  ASSERT_TRUE(shader) << shader.error().message;
  EXPECT_THAT(shader->files, ElementsAre("a/main.frag", "a/one.glsl", "a/two.glsl"));
  EXPECT_EQ(shader->text,
            "#version 450 core\n#define SHADOWS \n#define TAPS 4\n// first\nint two;\n"
            "int one;\n\nvoid main() {}\n\n");
  // Errors in each line of the text, as Mesa words them, land where the line came from.
  std::string log;
  for (std::size_t i = 1; i <= shader->lines.size(); ++i) log += fmt::format("0:{}(1): e\n", i);
  EXPECT_EQ(mapShaderLog(log, *shader),
            "(defines): e\n(defines): e\n(defines): e\na/main.frag:1: e\n"
            "a/two.glsl:2: e\na/one.glsl:2: e\na/one.glsl:3: e\na/main.frag:4: e\n"
            "a/main.frag:5: e");
}

TEST(ShaderSources, FaultsNameFileAndLine) {
  const auto fault = [](const char* path) {
    const auto result = sources().expand(path, {});
    EXPECT_FALSE(result);
    EXPECT_EQ(result.error().kind, ErrorKind::Pipeline);
    return result.error().message;
  };
  EXPECT_THAT(fault("a/missing.frag"), HasSubstr("a/missing.frag:2: error: no shader file"));
  EXPECT_THAT(fault("a/missing.frag"), HasSubstr("did you mean 'a/two.glsl'"));
  EXPECT_THAT(fault("a/version.frag"), HasSubstr("a/version.frag:1: error: #version"));
  EXPECT_THAT(fault("a/unquoted.frag"), HasSubstr("a/unquoted.frag:1: error: found"));
  EXPECT_THAT(fault("a/nowhere.frag"), HasSubstr("'a/nowhere.frag'"));
}

TEST(ShaderSources, EmbeddingKeepsEveryByte) {
  std::size_t awkward = 0;
  for (const EmbeddedShader& shader : embeddedShaders_gpu_test()) {
    const auto text = readText(fs::path(LUCERNA_SOURCE_DIR) / "src" / shader.path);
    ASSERT_TRUE(text) << text.error().message;
    EXPECT_EQ(shader.text, *text) << shader.path;
    awkward += shader.text.find("[[ ]]") != std::string_view::npos;
  }
  EXPECT_EQ(embeddedShaders_gpu_test().size(), 2u);
  EXPECT_EQ(awkward, 1u);
}

class ShaderRoot : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(root_ / "a"); }
  void write(const fs::path& name, const std::string& text) {
    std::ofstream(root_ / name) << text;
    // Two writes within a tick of the file system's clock would look like one.
    fs::last_write_time(root_ / name,
                        fs::file_time_type::clock::now() + std::chrono::seconds(++writes_));
  }
  TestFolder own_;
  fs::path root_ = own_.path();
  int writes_ = 0;
};

TEST_F(ShaderRoot, IsReadBeforeTheEmbeddedText) {
  write("a/two.glsl", "int changed;\n");
  ShaderSources shaders = sources();
  shaders.setRoot(root_);
  const auto shader = shaders.expand("a/one.glsl", {});
  ASSERT_TRUE(shader) << shader.error().message;
  EXPECT_THAT(shader->text, HasSubstr("int changed;"));
  EXPECT_THAT(shader->text, HasSubstr("int one;"));
}

TEST_F(ShaderRoot, ReportsChangesOnce) {
  write("a/old.frag", "");
  write("a/gone.frag", "");
  write("a/notes.txt", "");
  ShaderSources shaders = sources();
  shaders.setRoot(root_);
  EXPECT_THAT(shaders.changedFiles(), ElementsAre());
  write("a/old.frag", "changed");
  write("a/new.glsl", "");
  write("a/notes.txt", "changed");
  fs::remove(root_ / "a/gone.frag");
  EXPECT_THAT(shaders.changedFiles(), ElementsAre("a/gone.frag", "a/new.glsl", "a/old.frag"));
  EXPECT_THAT(shaders.changedFiles(), ElementsAre());
}

TEST_F(ShaderRoot, UsersFilesIncludeWhatStandsBesideThemThenWhatIsCompiledIn) {
  write("a/user.frag", "#include \"beside.glsl\"\n#include \"a/two.glsl\"\n");
  write("a/beside.glsl", "#include \"a/one.glsl\"\nint beside;\n");
  ShaderSources shaders = sources();
  const std::string user = (root_ / "a/user.frag").string();
  const std::string beside = (root_ / "a/beside.glsl").string();
  const auto shader = shaders.expand(user, {});
  ASSERT_TRUE(shader) << shader.error().message;
  EXPECT_THAT(shader->files, ElementsAre(user, beside, "a/one.glsl", "a/two.glsl"));

  EXPECT_THAT(shaders.changedFiles(), ElementsAre());
  write("a/beside.glsl", "int changed;\n");
  EXPECT_THAT(shaders.changedFiles(), ElementsAre(beside));
  fs::remove(user);
  EXPECT_THAT(shaders.changedFiles(), ElementsAre(user));
  const auto gone = shaders.expand(user, {});
  ASSERT_FALSE(gone);
  EXPECT_EQ(gone.error().kind, ErrorKind::Pipeline);
  EXPECT_THAT(gone.error().message, HasSubstr(user + ": cannot be opened"));
  write("a/user.frag", "");
  EXPECT_THAT(shaders.changedFiles(), ElementsAre(user));
}

TEST(ShaderLog, ThreeDriversFormsAreMapped) {
  const ExpandedShader shader{"", {"a/main.frag", "a/one.glsl"}, {{-1, 0}, {0, 7}, {1, 12}}};
  EXPECT_EQ(mapShaderLog("0:3(8): error: `x' undeclared\n", shader),
            "a/one.glsl:12: error: `x' undeclared");
  EXPECT_EQ(mapShaderLog("0(2) : error C1503: undefined variable \"x\"", shader),
            "a/main.frag:7: error C1503: undefined variable \"x\"");
  EXPECT_EQ(mapShaderLog("ERROR: 0:3: 'x' : undeclared identifier\r\nWARNING: 0:2: odd", shader),
            "a/one.glsl:12: error: 'x' : undeclared identifier\na/main.frag:7: warning: odd");
  EXPECT_EQ(mapShaderLog("0:4(3): error: of no line\nsomething else", shader),
            "0:4(3): error: of no line\nsomething else");
  for (const char* odd : {"0:3", "0:3(", "0:3(1)", "0(3", "0(3) x", ":3: x",
                          "99999999999999999999:3: x", "ERROR: none", "0:-1: x", "0:0: x"})
    EXPECT_EQ(mapShaderLog(odd, shader), odd);
  EXPECT_EQ(mapShaderLog("", shader), "");
}

}  // namespace
}  // namespace lucerna::gpu
