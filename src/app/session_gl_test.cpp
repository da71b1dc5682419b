#include "app/session.hpp"

#include <gmock/gmock.h>

#include <cstdlib>
#include <filesystem>

#include "app/frame.hpp"
#include "app/frame_writer.hpp"
#include "core/file.hpp"
#include "image/image_file.hpp"

namespace lucerna::app {
namespace {

using testing::HasSubstr;

class SessionTest : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = testing::TempDir() + "lucerna-session-XXXXXX";
    folder_ = mkdtemp(pattern.data());
    settings_.scene = "builtin:atrium?lights=2";
    settings_.size = {96, 54};
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  // Renders settings_ by `writer`; no medium message of GL is expected.
  Status renderBy(FrameWriter& writer) {
    auto session = openSession(settings_, writer.layers());
    if (!session) return session.error();
    for (std::uint64_t i = 0; i < settings_.frames; ++i)
      LUCERNA_TRY_VOID(
          runFrame(**session, nullptr, [&](Session& s, int view, const gpu::Texture& texture) {
            return writer.write(s, view, texture);
          }));
    EXPECT_EQ((*session)->glMessages, 0);
    return {};
  }

  // Into `name`; returns the path of the first frame.
  std::string render(const std::string& name, std::vector<std::string> layers = {},
                     std::optional<ComponentType> type = {}) {
    const OutputSettings output{
        .path = folder_ / name, .layers = std::move(layers), .exrType = type};
    auto writer = FrameWriter::create(output, settings_);
    EXPECT_TRUE(writer) << writer.error().message;
    const Status status = renderBy(*writer);
    EXPECT_TRUE(status) << status.error().message;
    return writer->written().empty() ? "" : writer->written().front().string();
  }

  std::filesystem::path folder_;
  RenderSettings settings_;
};

TEST_F(SessionTest, WritesAPictureOfTheOutputsSizeAtAnyScale) {
  for (const int scale : {25, 100, 200}) {
    settings_.scale = scale;
    const auto image = readImage(render(std::to_string(scale) + ".png"));
    ASSERT_TRUE(image) << image.error().message;
    EXPECT_EQ(image->width(), 96);
    EXPECT_EQ(image->height(), 54);
    EXPECT_EQ(image->type(), ComponentType::U8);
  }
}

TEST_F(SessionTest, AnOutputOfAnotherSizeIsRefusedAndNothingWritten) {
  ASSERT_TRUE(writeText(folder_ / "half.frag",
                        "layout(location = 0) out vec4 made;\nvoid main() { made = vec4(1); }\n"));
  ASSERT_TRUE(writeText(
      folder_ / "half.js",
      "pass('Fullscreen', {shader: 'half.frag', format: 'Rgba8Unorm', outputScale: 0.5});\n"));
  settings_.pipeline = folder_ / "half.js";
  const OutputSettings output{.path = folder_ / "half.png", .layers = {}, .exrType = {}};
  auto writer = FrameWriter::create(output, settings_);
  ASSERT_TRUE(writer) << writer.error().message;
  const Status status = renderBy(*writer);
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().kind, ErrorKind::Pipeline);
  EXPECT_THAT(status.error().message, testing::HasSubstr("48 x 27 px"));
  EXPECT_THAT(status.error().message, testing::HasSubstr("outputScale"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "half.png"));
}

TEST_F(SessionTest, TheSameSettingsGiveTheSameBytes) {
  const auto first = readFile(render("a.png")), second = readFile(render("b.png"));
  ASSERT_TRUE(first && second);
  EXPECT_EQ(*first, *second);
}

TEST_F(SessionTest, ExrHoldsTheLayersAskedFor) {
  const std::string path =
      render("layers.exr", {"color", "depth", "normal", "albedo"}, ComponentType::F32);
  const auto layers = readExrLayers(path);
  ASSERT_TRUE(layers) << layers.error().message;
  std::map<std::string, const Image*> byName;
  for (const ExrLayer& layer : *layers) byName[layer.name] = &layer.image;
  ASSERT_EQ(byName.size(), 4u);
  ASSERT_TRUE(byName.count("") && byName.count("depth") && byName.count("normal") &&
              byName.count("albedo"));

  // Inside a hall, depths are metres to its walls, normals unit vectors where depth is finite.
  const Image& depth = *byName["depth"];
  const Image& normal = *byName["normal"];
  int covered = 0;
  for (int y = 0; y < depth.height(); ++y)
    for (int x = 0; x < depth.width(); ++x) {
      const float metres = depth.pixel<float>(x, y)[0];
      EXPECT_GT(metres, 0.f);
      if (metres > 1e4f) continue;
      ++covered;
      const float* n = normal.pixel<float>(x, y);
      EXPECT_NEAR(glm::length(vec3(n[0], n[1], n[2])), 1.f, 1e-3f);
    }
  EXPECT_GT(covered, depth.width() * depth.height() / 2);
}

TEST_F(SessionTest, NormalsAreZeroWhereNothingIsAlsoWithoutTheDepthLayer) {
  settings_.scene = "builtin:nightcity";
  settings_.camera = "aerial";
  const auto zeros = [&](const std::vector<std::string>& layers) {
    const auto read = readExrLayers(render("normals.exr", layers, ComponentType::F32));
    EXPECT_EQ(read->size(), layers.size());
    const auto normal =
        std::ranges::find_if(*read, [](const ExrLayer& layer) { return layer.name == "normal"; });
    int count = 0;
    for (int y = 0; y < normal->image.height(); ++y)
      for (int x = 0; x < normal->image.width(); ++x) {
        const float* n = normal->image.pixel<float>(x, y);
        count += vec3(n[0], n[1], n[2]) == vec3(0.f);
      }
    return count;
  };
  const int expected = zeros({"normal", "depth"});
  EXPECT_GT(expected, 10);
  EXPECT_EQ(zeros({"normal"}), expected);
}

TEST_F(SessionTest, ALayerThatThePipelineLacksIsAUsageError) {
  settings_.pipeline = "forward";
  auto session = openSession(settings_, {LayerKind::Albedo});
  ASSERT_TRUE(session) << session.error().message;
  const Status status =
      runFrame(**session, nullptr, [](Session&, int, const gpu::Texture&) { return Status(); });
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().kind, ErrorKind::Usage);
  EXPECT_THAT(status.error().message, HasSubstr("albedo"));
}

TEST_F(SessionTest, ExposureMakesThePictureBrighter) {
  const auto sum = [](const Image& image) {
    double total = 0;
    for (const std::uint8_t value : image.as<std::uint8_t>()) total += value;
    return total;
  };
  settings_.exposure = -3.f;
  const auto dark = readImage(render("dark.png"));
  settings_.exposure = 1.f;
  const auto bright = readImage(render("bright.png"));
  ASSERT_TRUE(dark && bright);
  EXPECT_GT(sum(*bright), 1.5 * sum(*dark));
}

// A wall seen from its back: the light that a scene without lights gets is at the camera in use.
TEST_F(SessionTest, TheHeadlightGoesWithTheChosenCamera) {
  const auto write = [&](const char* name, std::string_view text) {
    EXPECT_TRUE(writeFile(folder_ / name, std::as_bytes(std::span(text))));
    return (folder_ / name).string();
  };
  settings_.scene = write("wall.obj", "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3\nf 1 3 4\n");
  settings_.sets = {"ToneMap.operator=linear", "GBuffer.backFaces=true"};
  settings_.camera =
      write("back.json", R"({"position": [0, 0, -1], "target": [0, 0, 0], "fovY": 30})");
  const auto fromCamera = readImage(render("camera.png"));
  ASSERT_TRUE(fromCamera) << fromCamera.error().message;
  EXPECT_GT(fromCamera->pixel<std::uint8_t>(48, 27)[1], 150);

  settings_.camera.clear();
  settings_.cameraPath = write("path.json", R"({"keyframes": [
      {"time": 0, "position": [0, 0, 1], "target": [0, 0, 0], "fovY": 30},
      {"time": 1, "position": [0, 0, -1], "target": [0, 0, 0], "fovY": 30}]})");
  settings_.time = 1;
  const auto onPath = readImage(render("path.png"));
  ASSERT_TRUE(onPath) << onPath.error().message;
  EXPECT_GT(onPath->pixel<std::uint8_t>(48, 27)[1], 150);
}

// Passes with caches see a new scene in the first frame, also if it moves at once; then what moved.
TEST_F(SessionTest, ChangesAddUpUntilAFrameHasRun) {
  settings_.scene = "builtin:atrium?lights=2&moving=0.1";
  settings_.timeStep = 0.1;
  auto opened = openSession(settings_);
  ASSERT_TRUE(opened) << opened.error().message;
  ASSERT_FALSE((*opened)->scene.animations.empty());
  std::vector<render::SceneChanges> seen;
  const FrameSink note = [&](Session& s, int, const gpu::Texture&) {
    seen.push_back(s.gpuScene.changes);
    return Status();
  };
  for (int frame = 0; frame < 2; ++frame) {
    const Status status = runFrame(**opened, nullptr, note);
    ASSERT_TRUE(status) << status.error().message;
  }
  ASSERT_EQ(seen.size(), 2u);
  EXPECT_TRUE(seen[0].everything && seen[0].materials && seen[0].lights);
  EXPECT_TRUE(seen[1].lights);
  EXPECT_FALSE(seen[1].everything || seen[1].materials);
  EXPECT_FALSE(seen[1].movedObjects.empty());
}

TEST_F(SessionTest, AChangedPipelineFileIsReadAgainAndAFaultyOneLeavesTheLast) {
  const std::filesystem::path file = folder_ / "mine.js";
  const auto write = [&](const std::string& text, int seconds) {
    ASSERT_TRUE(writeText(file, text));
    std::filesystem::last_write_time(
        file, std::filesystem::file_time_type::clock::now() + std::chrono::seconds(seconds));
  };
  const std::string rows = "pass('Cull'); pass('GBuffer'); pass('TiledLighting'); ";
  write(rows + "pass('ToneMap');", 0);
  settings_.pipeline = file;
  auto opened = openSession(settings_);
  ASSERT_TRUE(opened) << opened.error().message;
  Session& session = **opened;
  session.watch = true;
  const FrameSink ignore = [](Session&, int, const gpu::Texture&) { return Status(); };
  ASSERT_TRUE(runFrame(session, nullptr, ignore));
  EXPECT_EQ(session.pipeline.passes.size(), 4u);

  write(rows + "pass('Background'); pass('ToneMap');", 2);
  ASSERT_TRUE(runFrame(session, nullptr, ignore));
  EXPECT_EQ(session.pipeline.passes.size(), 5u);

  // Neither a script that does not parse nor rows that do not fit together.
  int seconds = 4;
  for (const char* faulty : {"pass('Cull'", "pass('TiledLighting'); pass('ToneMap');"}) {
    write(faulty, seconds++);
    const Status status = runFrame(session, nullptr, ignore);
    ASSERT_TRUE(status) << status.error().message;
    EXPECT_EQ(session.pipeline.passes.size(), 5u);
  }
}

// Faults that show only when the schedule is built: a layer that nobody writes any more, a shader
// that does not compile.
TEST_F(SessionTest, AReloadedPipelineThatCannotBeDrawnLeavesTheLast) {
  const std::filesystem::path file = folder_ / "mine.js", shaders = folder_ / "shaders";
  std::filesystem::create_directories(shaders / "render");
  ASSERT_TRUE(writeText(shaders / "render/background.frag", "void main() { nonsense; }"));
  const auto write = [&](const std::string& text, int seconds) {
    ASSERT_TRUE(writeText(file, text));
    std::filesystem::last_write_time(
        file, std::filesystem::file_time_type::clock::now() + std::chrono::seconds(seconds));
  };
  const std::string rows = "pass('Cull'); pass('GBuffer'); pass('TiledLighting'); ";
  write(rows + "pass('ToneMap');", 0);
  settings_.pipeline = file;
  settings_.shaderFolder = shaders;
  auto opened = openSession(settings_, {LayerKind::Albedo});
  ASSERT_TRUE(opened) << opened.error().message;
  Session& session = **opened;
  session.watch = true;
  std::vector<Image> pictures;
  const FrameSink keep = [&](Session& s, int, const gpu::Texture& output) {
    pictures.push_back(s.device->download(output));
    return Status();
  };
  ASSERT_TRUE(runFrame(session, nullptr, keep));
  int seconds = 2;
  for (const std::string& failing : {std::string("pass('Cull'); pass('Forward'); pass('ToneMap');"),
                                     rows + "pass('Background'); pass('ToneMap');"}) {
    write(failing, seconds++);
    for (int frame = 0; frame < 2; ++frame) {
      const Status status = runFrame(session, nullptr, keep);
      ASSERT_TRUE(status) << status.error().message;
      EXPECT_EQ(session.pipeline.passes.size(), 4u);
      EXPECT_TRUE(std::ranges::equal(pictures.front().bytes(), pictures.back().bytes()));
    }
  }
  EXPECT_EQ(pictures.size(), 5u);
  static_cast<void>(session.device->takeDebugMessages());
}

TEST_F(SessionTest, AShaderThatNoLongerCompilesLeavesTheLast) {
  const std::filesystem::path shader = folder_ / "passes/tone_map/tone_map.frag";
  std::filesystem::create_directories(shader.parent_path());
  std::filesystem::copy_file(
      std::filesystem::path(LUCERNA_SOURCE_DIR) / "src/passes/tone_map/tone_map.frag", shader);
  settings_.shaderFolder = folder_;
  auto opened = openSession(settings_);
  ASSERT_TRUE(opened) << opened.error().message;
  (*opened)->watch = true;
  int drawn = 0;
  const FrameSink count = [&](Session&, int, const gpu::Texture&) {
    ++drawn;
    return Status();
  };
  ASSERT_TRUE(runFrame(**opened, nullptr, count));
  ASSERT_TRUE(writeText(shader, "void main() { nonsense; }"));
  std::filesystem::last_write_time(
      shader, std::filesystem::file_time_type::clock::now() + std::chrono::seconds(2));
  const Status status = runFrame(**opened, nullptr, count);
  EXPECT_TRUE(status) << status.error().message;
  EXPECT_EQ(drawn, 2);
}

// A Fullscreen row's description follows from its shader: its ports and parameters change with the
// file, and a shader that is broken or does not fit the row leaves the last one.
TEST_F(SessionTest, AChangedShaderOfAFullscreenRowIsReadAgainAndAFaultyOneLeavesTheLast) {
  int seconds = 0;
  const auto write = [&](const char* name, const std::string& text) {
    ASSERT_TRUE(writeText(folder_ / name, text));
    std::filesystem::last_write_time(folder_ / name, std::filesystem::file_time_type::clock::now() +
                                                         std::chrono::seconds(seconds++));
  };
  const std::string output = "layout(location = 0) out vec4 made;\n";
  write("own.glsl", "const float blue = 0.0;\n");
  write("a.frag",
        output + "uniform float red = 0.2;\nvoid main() { made = vec4(red, 0, 0, 1); }\n");
  write("mine.js", "pass('Fullscreen', {shader: 'a.frag', format: 'Rgba8Unorm', red: 0.4});\n");
  settings_.pipeline = folder_ / "mine.js";
  auto opened = openSession(settings_);
  ASSERT_TRUE(opened) << opened.error().message;
  Session& session = **opened;
  session.watch = true;
  std::array<int, 3> seen{};
  const auto draw = [&] {
    const Status status =
        runFrame(session, nullptr, [&](Session& s, int, const gpu::Texture& texture) {
          const Image picture = s.device->download(texture);
          std::copy_n(picture.pixel<std::uint8_t>(4, 4), 3, seen.begin());
          return Status();
        });
    EXPECT_TRUE(status) << status.error().message;
    return seen;
  };
  using Rgb = std::array<int, 3>;
  EXPECT_EQ(draw(), (Rgb{102, 0, 0}));

  // Another uniform, a port and an include.
  write("a.frag", output +
                      "#include \"own.glsl\"\nuniform float red;\nuniform float green = 0.6;\n"
                      "void main() { made = vec4(red, green, blue, 1); }\n");
  EXPECT_EQ(draw(), (Rgb{102, 153, 0}));
  EXPECT_NE(session.executor->plan().rows[0].description.param("green"), nullptr);
  write("own.glsl", "const float blue = 1.0;\n");
  EXPECT_EQ(draw(), (Rgb{102, 153, 255}));

  // It does not compile; then it lacks what the row sets, which the pipeline mends.
  write("a.frag", output + "uniform float red;\nvoid main() { made = nonsense; }\n");
  EXPECT_EQ(draw(), (Rgb{102, 153, 255}));
  write("a.frag", output + "uniform int level;\nvoid main() { made = vec4(level, 1, 0, 1); }\n");
  EXPECT_EQ(draw(), (Rgb{102, 153, 255}));
  write("mine.js", "pass('Fullscreen', {shader: 'a.frag', format: 'Rgba8Unorm', level: 1});\n");
  EXPECT_EQ(draw(), (Rgb{255, 255, 0}));

  // A pipeline that is valid but names a shader that does not compile.
  write("b.frag", "void main() { nonsense; }\n");
  write("mine.js", "pass('Fullscreen', {shader: 'b.frag', format: 'Rgba8Unorm'});\n");
  EXPECT_EQ(draw(), (Rgb{255, 255, 0}));
  write("b.frag", output + "void main() { made = vec4(0, 0, 1, 1); }\n");
  EXPECT_EQ(draw(), (Rgb{0, 0, 255}));
}

TEST_F(SessionTest, AFaultyPipelineRendersNothing) {
  const std::filesystem::path file = folder_ / "bad.json";
  ASSERT_TRUE(
      writeText(file, R"({"lucerna": "pipeline/1", "passes": [{"type": "TiledLightning"}]})"));
  settings_.pipeline = file;
  auto session = openSession(settings_);
  ASSERT_TRUE(session) << session.error().message;
  bool drawn = false;
  const Status status = runFrame(**session, nullptr, [&](Session&, int, const gpu::Texture&) {
    drawn = true;
    return Status();
  });
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().kind, ErrorKind::Pipeline);
  EXPECT_THAT(status.error().message, HasSubstr("did you mean 'TiledLighting'"));
  EXPECT_FALSE(drawn);
}

}  // namespace
}  // namespace lucerna::app
