#include <array>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "core/test_folder.hpp"
#include "gpu/gl_test_fixture.hpp"

namespace lucerna::gpu {
namespace {

using testing::HasSubstr;
using ProgramGlTest = GlTest;
namespace fs = std::filesystem;

std::uint32_t firstWord(const std::vector<std::byte>& bytes, std::size_t index = 0) {
  std::uint32_t word = 0;
  std::memcpy(&word, bytes.data() + 4 * index, 4);
  return word;
}

TEST_F(ProgramGlTest, EveryUniformTypeArrives) {
  static constexpr EmbeddedShader kShader{"test/uniforms.comp",
                                          R"(layout(local_size_x = 1) in;
uniform float f; uniform int i; uniform bool b; uniform uint u; uniform vec2 v2; uniform vec3 v3;
uniform vec4 v4; uniform ivec2 iv; uniform mat3 m3; uniform mat4 m4; uniform float fs[3];
uniform vec3 v3s[2]; uniform vec4 v4s[2];
buffer Result { float result[]; };
void main() {
  result[0] = f; result[1] = float(i); result[2] = b ? 1.0 : 0.0; result[3] = float(u);
  result[4] = v2.y; result[5] = v3.z; result[6] = v4.w; result[7] = float(iv.y);
  result[8] = m3[2][1]; result[9] = m4[3][2]; result[10] = fs[1]; result[11] = v3s[1].y;
  result[12] = v4s[1].w;
})"};
  device().shaderSources().add({&kShader, 1});
  const ProgramPtr program = device().program({.compute = "test/uniforms.comp"});
  mat3 m3(0.f);
  m3[2][1] = 9.f;
  mat4 m4(0.f);
  m4[3][2] = 10.f;
  const float fs[] = {0.f, 11.f};
  const vec3 v3s[] = {vec3(0.f), vec3(0.f, 12.f, 0.f)};
  const vec4 v4s[] = {vec4(0.f), vec4(0.f, 0.f, 0.f, 13.f)};
  program->set("f", 1.f);
  program->set("i", 2);
  program->set("b", true);
  program->set("u", 4u);
  program->set("v2", vec2(0.f, 5.f));
  program->set("v3", vec3(0.f, 0.f, 6.f));
  program->set("v4", vec4(0.f, 0.f, 0.f, 7.f));
  program->set("iv", ivec2(0, 8));
  program->set("m3", m3);
  program->set("m4", m4);
  program->set("fs", fs);
  program->set("v3s", v3s);
  program->set("v4s", v4s);
  program->set("not there", 1.f);
  const Buffer result = device().createBuffer(13 * sizeof(float), "result");
  {
    Computing computing = device().compute();
    computing.use(*program);
    computing.buffer("Result", result);
    computing.dispatch(1);
  }
  device().barrier();
  const std::vector<std::byte> bytes = device().download(result);
  std::array<float, 13> found{};
  ASSERT_GE(bytes.size(), sizeof(found));
  std::memcpy(found.data(), bytes.data(), sizeof(found));
  EXPECT_THAT(found, testing::ElementsAre(1, 2, 1, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13));
  EXPECT_EQ(device().counters().dispatches, 1u);
  EXPECT_DEATH(program->set("f", vec2(1.f)), "another type");
  EXPECT_DEATH(program->set("v4s", std::vector<vec4>(3)), "has 2 elements, given 3");
}

TEST_F(ProgramGlTest, ComputeReadsUniformBlocksAndWritesImagesAndStorage) {
  static constexpr EmbeddedShader kShader{"test/images.comp",
                                          R"(layout(local_size_x = 2, local_size_y = 2) in;
layout(std140) uniform Numbers { uvec4 add, unused; };
layout(std430) buffer Sum { uint sum; };
layout(r32ui) uniform uimage2D counts;
layout(rgba16f) writeonly uniform image2D colors;
void main() {
  ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  uint value = imageLoad(counts, p).x + add.y;
  imageStore(counts, p, uvec4(value));
  imageStore(colors, p, vec4(float(p.x), float(p.y), 0.0, 1.0));
  atomicAdd(sum, value);
})"};
  device().shaderSources().add({&kShader, 1});
  const ProgramPtr program = device().program({.compute = "test/images.comp"});
  const Texture counts = target(Format::R32Uint), colors = target(Format::Rgba16Float);
  device().clear(counts, vec4(5.f));
  const std::vector<std::uint32_t> numbers = {1, 10, 100, 1000, 0, 0, 0, 0}, zero = {0};
  const Buffer block = device().createBuffer(bytesOf(numbers), "numbers");
  const Buffer sum = device().createBuffer(bytesOf(zero), "sum");
  {
    Computing computing = device().compute();
    computing.use(*program);
    computing.buffer("Numbers", block);
    computing.buffer("Sum", sum);
    computing.image("counts", counts);
    computing.image("colors", colors);
    computing.dispatch(2, 2);
  }
  device().barrier();
  EXPECT_EQ(firstWord(device().download(sum)), 16u * 15);
  EXPECT_EQ(device().download(counts).as<std::uint32_t>()[7], 15u);
  const Image image = device().download(colors, 0, false);
  EXPECT_EQ(floatFromHalf(image.pixel<std::uint16_t>(3, 2)[0]), 3.f);
  EXPECT_EQ(floatFromHalf(image.pixel<std::uint16_t>(3, 2)[1]), 2.f);
  const Buffer small = device().createBuffer(4, "small");
  EXPECT_DEATH(
      {
        Computing computing = device().compute();
        computing.use(*program);
        computing.buffer("Numbers", small);
        computing.buffer("Sum", sum);
        computing.image("counts", counts);
        computing.image("colors", colors);
        computing.dispatch(1);
      },
      "block 'Numbers' reads 32 bytes, its buffer has 4");
}

TEST_F(ProgramGlTest, SamplerArraysAndShadowSamplersBindByName) {
  static constexpr EmbeddedShader kShader{"test/samplers.frag",
                                          R"(uniform sampler2D maps[2];
uniform sampler2DArrayShadow shadows;
uniform usampler2D ids;
layout(location = 0) out vec4 color;
void main() {
  color = vec4(texture(maps[0], vec2(0.5)).x, texture(maps[1], vec2(0.5)).x,
               texture(shadows, vec4(0.5, 0.5, 1.0, 0.5)), float(texelFetch(ids, ivec2(0), 0).x));
})"};
  const ProgramPtr program = fragment(kShader);
  const Texture a = target(Format::R8Unorm), b = target(Format::R32Float);
  const Texture ids = target(Format::R32Uint), color = target(Format::Rgba32Float);
  const Texture shadows = device().createTexture({.kind = TextureKind::Array2D,
                                                  .format = Format::Depth32F,
                                                  .width = 4,
                                                  .height = 4,
                                                  .layers = 2},
                                                 "shadows");
  device().clear(a, vec4(1.f));
  device().clear(b, vec4(3.f));
  device().clear(ids, vec4(4.f));
  device().render({.depth = {&shadows, Load::Clear, 0.9f, 0, 0}});
  device().render({.depth = {&shadows, Load::Clear, 0.2f, 0, 1}});
  {
    Rendering draw = device().render({.colors = {{&color, Load::Discard}}});
    draw.use(*program, {});
    draw.texture("maps[0]", a, kLinear);
    draw.texture("maps[1]", b, kNearest);
    draw.texture("shadows", shadows, {.compareGreaterEqual = true});
    draw.texture("ids", ids, kNearest);
    draw.fullscreen();
  }
  EXPECT_EQ(firstPixel(color), vec4(1.f, 3.f, 1.f, 4.f));  // 0.5 >= 0.2: lit
}

TEST_F(ProgramGlTest, FaultsNameFileAndLineAfterIncludes) {
  static constexpr EmbeddedShader kShaders[] = {
      {"test/broken.frag",
       "#include \"test/fine.glsl\"\n\nlayout(location = 0) out vec4 c;\n"
       "void main() {\n  c = vec4(missing);\n}\n"},
      {"test/fine.glsl", "float fine;\nfloat alsoFine;\n"},
      {"test/indirect.frag", "\n#include \"test/bad.glsl\"\nvoid main() {}\n"},
      {"test/bad.glsl", "// one\n// two\nfloat x = nonsense;\n"},
      {"test/unlinked.frag",
       "float elsewhere();\nlayout(location = 0) out float c;\n"
       "void main() { c = elsewhere(); }\n"}};
  device().shaderSources().add(kShaders);
  const auto fault = [&](const char* path) {
    const ProgramPtr program = device().program(
        {.vertex = "gpu/fullscreen.vert", .fragment = path, .defines = {{"TAPS", "4"}}});
    EXPECT_FALSE(program->usable());
    EXPECT_EQ(device().program(program->desc()), program);  // asked twice, reported once
    const std::vector<Error> errors = device().takeErrors();
    EXPECT_EQ(errors.size(), 1u);
    if (errors.empty()) return std::string();
    EXPECT_EQ(device().program(program->desc()), program);  // asked later, reported again
    EXPECT_EQ(device().takeErrors().size(), 1u);
    EXPECT_EQ(errors[0].kind, ErrorKind::Pipeline);
    EXPECT_THAT(errors[0].message, HasSubstr("TAPS=4"));
    return errors[0].message;
  };
  EXPECT_THAT(fault("test/broken.frag"), HasSubstr("test/broken.frag:5: error"));
  EXPECT_THAT(fault("test/indirect.frag"), HasSubstr("test/bad.glsl:3: error"));
  EXPECT_THAT(fault("test/unlinked.frag"), HasSubstr("test/unlinked.frag: error: does not link"));

  // Draws with what did not compile do nothing.
  const Texture color = target(Format::R8Unorm);
  const ProgramPtr broken =
      device().program({.vertex = "gpu/fullscreen.vert", .fragment = "test/broken.frag"});
  EXPECT_EQ(device().takeErrors().size(), 1u);
  Rendering draw = device().render({.colors = {{&color, Load::Clear}}});
  draw.use(*broken, {});
  broken->set("anything", 1.f);
  draw.fullscreen();
  EXPECT_EQ(device().counters().draws, 0u);
  EXPECT_EQ(device().objectCounts().programs, 0);
}

TEST_F(ProgramGlTest, MissingFilesAreFaultsToo) {
  const ProgramPtr program =
      device().program({.vertex = "gpu/fullscreen.vert", .fragment = "test/nowhere.frag"});
  EXPECT_FALSE(program->usable());
  const std::vector<Error> errors = device().takeErrors();
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_THAT(errors[0].message, HasSubstr("test/nowhere.frag"));
}

TEST_F(ProgramGlTest, MediumPrecisionAndDefinesAreAccepted) {
  static constexpr EmbeddedShader kShader{
      "test/mediump.frag",
      "precision mediump float;\nlayout(location = 0) in mediump vec2 uv;\n"
      "layout(location = 0) out mediump vec4 color;\n"
      "void main() { lowp float half_ = VALUE; color = vec4(half_); }\n"};
  device().shaderSources().add({&kShader, 1});
  const Texture color = target(Format::R32Float);
  const auto value = [&](const char* text) {
    const ProgramPtr program = device().program({.vertex = "gpu/fullscreen.vert",
                                                 .fragment = "test/mediump.frag",
                                                 .defines = {{"VALUE", text}}});
    Rendering draw = device().render({.colors = {{&color, Load::Discard}}});
    draw.use(*program, {});
    draw.fullscreen();
    return firstPixel(color).x;
  };
  EXPECT_EQ(value("0.5"), 0.5f);
  EXPECT_EQ(value("0.25"), 0.25f);
  EXPECT_EQ(value("0.5"), 0.5f);
  EXPECT_EQ(device().objectCounts().programs, 2);
}

TEST_F(ProgramGlTest, ReloadKeepsTheLastGoodProgram) {
  const TestFolder folder;
  const fs::path root = folder.path();
  fs::create_directories(root / "test");
  int writes = 0;
  const auto write = [&](const char* name, const std::string& text) {
    std::ofstream(root / name) << text;
    fs::last_write_time(root / name,
                        fs::file_time_type::clock::now() + std::chrono::seconds(++writes));
  };
  write("test/value.glsl", "const float value = 1.0;\n");
  write("test/reload.frag",
        "#include \"test/value.glsl\"\nlayout(location = 0) out float color;\n"
        "uniform sampler2D source;\nvoid main() { color = value; }\n");
  device().shaderSources().setRoot(root);
  const ProgramPtr program =
      device().program({.vertex = "gpu/fullscreen.vert", .fragment = "test/reload.frag"});
  const Texture color = target(Format::R32Float);
  const auto drawn = [&] {
    Rendering draw = device().render({.colors = {{&color, Load::Clear}}});
    draw.use(*program, {});
    draw.fullscreen();
    return firstPixel(color).x;
  };
  EXPECT_EQ(drawn(), 1.f);
  const auto reload = [&] {
    return device().reloadShaders(device().shaderSources().changedFiles());
  };
  EXPECT_EQ(reload().value(), 0);
  write("test/value.glsl", "const float value = 2.0;\n");
  EXPECT_EQ(reload().value(), 1);
  EXPECT_EQ(drawn(), 2.f);

  // One that does not compile any more keeps all that changed with it.
  write("test/other.frag", "layout(location = 0) out float color;\nvoid main() { color = 7.0; }\n");
  const ProgramPtr other =
      device().program({.vertex = "gpu/fullscreen.vert", .fragment = "test/other.frag"});
  EXPECT_EQ(reload().value(), 1);
  write("test/value.glsl", "const float value = ;\n");
  write("test/other.frag",
        "uniform int added;\nlayout(location = 0) out float color;\n"
        "void main() { color = float(added); }\n");
  const auto failed = reload();
  ASSERT_FALSE(failed);
  EXPECT_THAT(failed.error().message, HasSubstr("test/value.glsl:1: error"));
  EXPECT_THAT(device().takeErrors(), testing::IsEmpty());
  EXPECT_TRUE(program->usable());
  EXPECT_EQ(drawn(), 2.f);
  EXPECT_THAT(other->inputs(), testing::IsEmpty());

  write("test/value.glsl", "const float value = 3.0;\n");
  EXPECT_EQ(reload().value(), 1);
  EXPECT_EQ(drawn(), 3.f);
  EXPECT_EQ(device().objectCounts().programs, 2);
}

}  // namespace
}  // namespace lucerna::gpu
