// Pictures in tiles and from two eyes against the single picture.
#include <gmock/gmock.h>

#include <cstdlib>
#include <filesystem>
#include <limits>

#include "app/frame.hpp"
#include "app/frame_writer.hpp"
#include "core/file.hpp"
#include "image/image_file.hpp"

namespace lucerna::app {
namespace {

using testing::HasSubstr;

class ViewsTest : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = testing::TempDir() + "lucerna-views-XXXXXX";
    folder_ = mkdtemp(pattern.data());
    settings_.scene = "builtin:atrium?lights=2";
    settings_.size = {96, 54};
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string write(const std::string& name, const std::string& text) {
    EXPECT_TRUE(writeText(folder_ / name, text));
    return (folder_ / name).string();
  }

  Status tryRender(const std::string& path, const std::vector<std::string>& layers) {
    OutputSettings output{.path = path, .layers = layers};
    if (path.ends_with(".exr")) output.exrType = ComponentType::F32;
    LUCERNA_TRY(writer, FrameWriter::create(output, settings_));
    LUCERNA_TRY(session, openSession(settings_, writer.layers()));
    LUCERNA_TRY_VOID(
        runFrame(*session, nullptr, [&](Session& s, int view, const gpu::Texture& texture) {
          return writer.write(s, view, texture);
        }));
    EXPECT_EQ(session->glMessages, 0);
    views_ = session->plan.places.size();
    return {};
  }

  // The layers of settings_' picture, by name.
  std::map<std::string, Image> layersOf(const std::vector<std::string>& layers = {}) {
    const std::string path = (folder_ / "picture.exr").string();
    const Status status = tryRender(path, layers);
    EXPECT_TRUE(status) << status.error().message;
    std::map<std::string, Image> result;
    if (!status) return result;
    auto read = readExrLayers(path);
    for (ExrLayer& layer : *read) result[layer.name] = std::move(layer.image);
    return result;
  }
  Image pictureOf() {
    const std::string path = (folder_ / "picture.png").string();
    const Status status = tryRender(path, {});
    EXPECT_TRUE(status) << status.error().message;
    return status ? readImage(path).value() : Image();
  }

  std::filesystem::path folder_;
  RenderSettings settings_;
  std::size_t views_ = 0;  // of the last picture
};

bool equal(const Image& a, const Image& b) {
  return a.width() == b.width() && a.height() == b.height() &&
         std::ranges::equal(a.bytes(), b.bytes());
}

// A row that writes where each pixel lies in the picture, and one that adds up what is around it.
class TilesTest : public ViewsTest {
 protected:
  void usePattern(int radius, int halo) {
    write("place.frag",
          "#include \"render/view.glsl\"\nlayout(location = 0) out vec4 color;\n"
          "void main() { color = vec4(gl_FragCoord.xy + view.window.xy, 0.0, 1.0); }\n");
    write("sum.frag",
          "uniform sampler2D color;\nuniform int radius = 1;\nlayout(location = 0) out vec4 sum;\n"
          "void main() {\n  sum = vec4(0.0);\n  ivec2 last = textureSize(color, 0) - 1;\n"
          "  for (int y = -radius; y <= radius; ++y)\n"
          "    for (int x = -radius; x <= radius; ++x)\n"
          "      sum += texelFetch(color, clamp(ivec2(gl_FragCoord.xy) + ivec2(x, y), ivec2(0), "
          "last), 0);\n}\n");
    settings_.pipeline = write("pattern.json", fmt::format(R"({{"lucerna": "pipeline/1", "passes": [
  {{"name": "Place", "type": "Fullscreen", "params": {{"shader": "place.frag", "format": "Rgba32Float"}}}},
  {{"name": "Sum", "type": "Fullscreen", "params": {{"shader": "sum.frag", "format": "Rgba32Float",
    "radius": {}, "halo": {}}}}}]}})",
                                                           radius, halo));
  }
};

TEST_F(TilesTest, EveryPixelIsAtItsPlace) {
  usePattern(0, 0);
  for (const uvec2 size : {uvec2(96, 54), uvec2(77, 131)}) {
    settings_.size = size;
    settings_.tile = 32;
    const Image picture = layersOf().at("");
    EXPECT_GT(views_, 1u);
    for (int y = 0; y < picture.height(); ++y)
      for (int x = 0; x < picture.width(); ++x) {
        const float* place = picture.pixel<float>(x, y);
        ASSERT_EQ(place[0], static_cast<float>(x) + 0.5f) << x << ", " << y;
        ASSERT_EQ(place[1], static_cast<float>(picture.height() - y) - 0.5f) << x << ", " << y;
      }
  }
}

TEST_F(TilesTest, PassesThatLookAroundJoinBitForBitThroughTheGuardBand) {
  settings_.size = {200, 170};
  for (const int radius : {1, 5, 20}) {
    usePattern(radius, radius);
    settings_.tile = 0;
    const Image whole = layersOf().at("");
    settings_.tile = 32;
    EXPECT_TRUE(equal(layersOf().at(""), whole)) << radius;
    EXPECT_GT(views_, 1u);
  }
}

TEST_F(TilesTest, APassThatLooksFartherThanItSaysShows) {
  usePattern(1, 0);
  const Image whole = layersOf().at("");
  settings_.tile = 32;
  EXPECT_FALSE(equal(layersOf().at(""), whole));
}

TEST_F(TilesTest, APassThatMayLookAnywhereIsRefused) {
  usePattern(1, -1);
  settings_.tile = 32;
  const Status status = tryRender((folder_ / "a.png").string(), {});
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().kind, ErrorKind::Usage);
  EXPECT_THAT(status.error().message, HasSubstr("'Sum.color' may need the whole picture"));
}

TEST_F(TilesTest, ARowThatWritesFilesIsRefused) {
  const std::string file = (folder_ / "saved.png").string();
  settings_.pipeline = write(
      "save.json",
      R"({"lucerna": "pipeline/1", "passes": [{"type": "Cull"}, {"type": "GBuffer"}, {"type": "TiledLighting"},
        {"type": "ToneMap"}, {"type": "SaveImage", "params": {"file": ")" +
          file + R"("}}]})");
  settings_.tile = 32;
  const Status status = tryRender((folder_ / "a.png").string(), {});
  ASSERT_FALSE(status);
  EXPECT_THAT(status.error().message, HasSubstr("'SaveImage' would write every tile"));
  EXPECT_FALSE(std::filesystem::exists(file));
  settings_.tile = 0;
  EXPECT_TRUE(tryRender((folder_ / "a.png").string(), {}));
  EXPECT_TRUE(std::filesystem::exists(file));
}

// Cards that face the camera: what is interpolated over them is the same number everywhere.
TEST_F(TilesTest, CardsJoinBitForBitInEveryLayer) {
  std::string obj, materials =
                       "newmtl c0\nKd 0.8 0.2 0.1\nnewmtl c1\nKd 0.1 0.7 0.3\nnewmtl c2\n"
                       "Kd 0.2 0.3 0.9\nnewmtl c3\nKd 0.9 0.8 0.2\nd 0.5\n";
  obj = "mtllib cards.mtl\n";
  for (int i = 0; i < 4; ++i) {
    const float x = -2.37f + 1.13f * static_cast<float>(i),
                y = 0.31f * static_cast<float>(i) - 1.1f;
    const float z = -0.4f * static_cast<float>(i);
    obj +=
        fmt::format("usemtl c{}\nv {} {} {}\nv {} {} {}\nv {} {} {}\nv {} {} {}\nf -4 -3 -2 -1\n",
                    i, x, y, z, x + 1.7f, y, z, x + 1.7f, y + 1.9f, z, x, y + 1.9f, z);
  }
  write("cards.obj", obj);
  write("cards.mtl", materials);
  settings_.scene =
      write("scene.json", R"({"lucerna": "scene/1", "include": [{"file": "cards.obj"}],
    "materials": {"c0": {"model": "phong", "specular": [0, 0, 0]}, "c1": {"model": "phong", "specular": [0, 0, 0]},
      "c2": {"model": "phong", "specular": [0, 0, 0]}, "c3": {"model": "phong", "specular": [0, 0, 0]}},
    "lights": [{"kind": "directional", "direction": [-1, -1, -2], "intensity": 3}],
    "cameras": [{"name": "front", "position": [0, 0, 4], "target": [0, 0, 0]}],
    "background": {"color": [0.1, 0.2, 0.4]}})");
  for (const char* pipeline : {"deferred", "forward"}) {
    SCOPED_TRACE(pipeline);
    settings_.pipeline = pipeline;
    const bool deferred = settings_.pipeline == "deferred";
    const std::vector<std::string> layers =
        deferred ? std::vector<std::string>{"color", "depth", "normal", "albedo"}
                 : std::vector<std::string>{"color", "depth"};
    settings_.tile = 0;
    const auto whole = layersOf(layers);
    const Image picture = pictureOf();
    settings_.tile = 32;
    for (const auto& [name, layer] : layersOf(layers))
      EXPECT_TRUE(equal(layer, whole.at(name))) << name;
    EXPECT_TRUE(equal(pictureOf(), picture));
  }
}

// How two pictures of 8 bits differ.
struct Difference {
  int greatest = 0;  // of 255
  double share = 0;  // of the pixels, by anything at all
};
Difference differenceOf(const Image& a, const Image& b) {
  Difference result;
  for (int y = 0; y < a.height(); ++y)
    for (int x = 0; x < a.width(); ++x) {
      int ofPixel = 0;
      for (int c = 0; c < 3; ++c)
        ofPixel = std::max(
            ofPixel, std::abs(a.pixel<std::uint8_t>(x, y)[c] - b.pixel<std::uint8_t>(x, y)[c]));
      result.greatest = std::max(result.greatest, ofPixel);
      result.share += ofPixel > 0 ? 1. / a.width() / a.height() : 0.;
    }
  return result;
}

float relativeDifference(const Image& a, const Image& b) {
  float result = 0;
  for (std::size_t i = 0; i < a.as<float>().size(); ++i) {
    const float first = a.as<float>()[i], second = b.as<float>()[i];
    if (first != second) result = std::max(result, std::abs(first - second) / std::abs(first));
  }
  return result;
}

// Slopes, mip levels, normal maps, glass, mirrors, lines and shaders of materials' own. A
// rasteriser counts from the corner of what it draws, so that the same plane comes out with another
// last bit; edges are the same. Measured: up to 0.32 % of the pixels by 2 of 255, depth by 1.6e-5.
TEST_F(TilesTest, SceneryJoinsButForRounding) {
  settings_.size = {320, 180};
  struct Case {
    const char *scene, *pipeline;
    int tile;
  };
  for (const auto& [scene, pipeline, tile] : {Case{"builtin:atrium?glass=1", "deferred", 64},
                                              {"builtin:atrium?glass=1", "forward", 112},
                                              {"builtin:atrium", "bvh", 112},
                                              {"builtin:atrium?lights=2", "sraa", 64},
                                              {"builtin:atrium", "pcf", 112},
                                              {"builtin:materials", "deferred", 64},
                                              {"builtin:materials", "forward", 112},
                                              {"builtin:mirrors", "deferred", 64},
                                              {"builtin:mirrors", "forward", 112}}) {
    SCOPED_TRACE(fmt::format("{}, {}", scene, pipeline));
    settings_.scene = scene;
    // From elsewhere single pixels of splinters, seen by two mirrors, differ by 29 of 255.
    settings_.camera = settings_.scene == "builtin:mirrors" ? "between" : "";
    settings_.pipeline = pipeline;
    settings_.tile = 0;
    const Image picture = pictureOf(), depth = layersOf({"depth"}).at("depth");
    settings_.tile = tile;
    const Difference difference = differenceOf(pictureOf(), picture);
    EXPECT_GT(views_, 1u);
    EXPECT_LE(difference.greatest, 2);
    EXPECT_LT(difference.share, 0.005);
    EXPECT_LT(relativeDifference(layersOf({"depth"}).at("depth"), depth), 3e-5f);
  }
}

// Each pixel gathers from circles around it, whose sizes follow from tiles of pixels around those.
TEST_F(TilesTest, DepthOfFieldJoinsButForRounding) {
  settings_.size = {320, 180};
  settings_.scene = "builtin:atrium";
  settings_.pipeline = "depth_of_field";
  for (const char* method : {"gather", "separable"}) {
    SCOPED_TRACE(method);
    settings_.sets = {"DepthOfField.lensRadius=1", "DepthOfField.focusDistance=12",
                      "DepthOfField.maximumRadius=10", "DepthOfField.steps=3",
                      std::string("DepthOfField.method=") + method};
    settings_.tile = 0;
    const Image picture = pictureOf();
    settings_.tile = 32;
    const Difference difference = differenceOf(pictureOf(), picture);
    EXPECT_GT(views_, 4u);
    EXPECT_LE(difference.greatest, 2);
    EXPECT_LT(difference.share, 0.01);
  }
}

// Longer than any viewport: tiles have viewports of their own.
TEST_F(TilesTest, WhatIsTooLongForAViewportIsAtItsPlace) {
  settings_.scene =
      write("edge.obj", "v 0 -9 0\nv 9 -9 0\nv 9 9 0\nv 0 9 0\nf 1 2 3 4\n");  // right of x = 0
  settings_.camera = write("camera.json", R"({"position": [0, 0, 5], "target": [0, 0, 0]})");
  settings_.size = {30000, 16};
  const Image depth = layersOf({"color", "depth"}).at("depth");
  EXPECT_GT(views_, 1u);
  EXPECT_EQ(depth.pixel<float>(14999, 8)[0], std::numeric_limits<float>::infinity());
  EXPECT_FLOAT_EQ(depth.pixel<float>(15000, 8)[0], 5.f);
}

class StereoTest : public ViewsTest {
 protected:
  static Image part(const Image& image, int x, int y, int width, int height) {
    Image result(width, height, image.channels(), image.type());
    for (int row = 0; row < height; ++row)
      std::copy_n(image.bytes().data() + (y + row) * image.rowBytes() +
                      static_cast<std::size_t>(x) * image.rowBytes() / image.width(),
                  result.rowBytes(), result.bytes().data() + row * result.rowBytes());
    return result;
  }
};

TEST_F(StereoTest, WithoutSeparationEachHalfIsTheMonoPicture) {
  for (const auto& [scene, pipeline] : {std::pair{"builtin:atrium?lights=2", "deferred"},
                                        {"builtin:atrium?lights=2", "forward"},
                                        {"builtin:atrium?lights=2", "pcf"},
                                        {"builtin:mirrors", "deferred"}}) {
    SCOPED_TRACE(fmt::format("{}, {}", scene, pipeline));
    settings_.scene = scene;
    settings_.pipeline = pipeline;
    settings_.stereo = {};
    const Image mono = pictureOf();
    settings_.stereo = {.layout = StereoLayout::SideBySide, .separation = 0.f};
    const Image beside = pictureOf();
    ASSERT_EQ(beside.width(), 192);
    EXPECT_TRUE(equal(part(beside, 0, 0, 96, 54), mono));
    EXPECT_TRUE(equal(part(beside, 96, 0, 96, 54), mono));
    settings_.stereo.layout = StereoLayout::TopBottom;
    const Image above = pictureOf();
    ASSERT_EQ(above.height(), 108);
    EXPECT_TRUE(equal(part(above, 0, 0, 96, 54), mono));
    EXPECT_TRUE(equal(part(above, 0, 54, 96, 54), mono));
    settings_.stereo.layout = StereoLayout::Anaglyph;
    EXPECT_TRUE(equal(pictureOf(), mono));
  }
}

// A wall at the convergence looks the same to both eyes; before it the left eye sees things farther
// right, behind it farther left.
TEST_F(StereoTest, ThingsAtTheConvergenceHaveNoParallax) {
  settings_.scene =
      write("edge.obj", "v 0 -9 0\nv 9 -9 0\nv 9 9 0\nv 0 9 0\nf 1 2 3 4\n");  // right of x = 0
  settings_.camera = write("camera.json", R"({"position": [0, 0, 5], "target": [0, 0, 0]})");
  settings_.size = {160, 20};
  settings_.stereo = {.layout = StereoLayout::TopBottom, .separation = 4.f};
  // Where the wall begins in the middle row of each eye's picture.
  const auto edges = [&](float convergence) {
    settings_.stereo.convergence = convergence;
    const Image depth = layersOf({"color", "depth"}).at("depth");
    const auto begin = [&](int row) {
      int x = 0;
      while (x < depth.width() && !(depth.pixel<float>(x, row)[0] < 1e3f)) ++x;
      return x;
    };
    return std::pair(begin(10), begin(30));
  };
  const auto [left, right] = edges(5.f);
  EXPECT_EQ(left, 80);
  EXPECT_EQ(right, 80);
  const auto [leftNear, rightNear] = edges(10.f);  // the wall stands before the screen
  EXPECT_GT(leftNear, rightNear);
  const auto [leftFar, rightFar] = edges(2.5f);
  EXPECT_LT(leftFar, rightFar);
  // p00 (e / d - e / c) of half the width: fovY 51.6 degrees, 8 times as wide.
  EXPECT_NEAR(leftNear - rightNear,
              160 / 8. / std::tan(0.5 * glm::radians(51.6)) * (2. / 5 - 2. / 10), 1.01);
}

TEST_F(StereoTest, AnaglyphsTakeRedFromTheLeftEye) {
  settings_.stereo = {.layout = StereoLayout::SideBySide, .separation = 0.5f};
  const Image beside = pictureOf();
  settings_.stereo.layout = StereoLayout::Anaglyph;
  const Image both = pictureOf();
  for (int y = 0; y < 54; ++y)
    for (int x = 0; x < 96; ++x) {
      const std::uint8_t* pixel = both.pixel<std::uint8_t>(x, y);
      ASSERT_EQ(pixel[0], beside.pixel<std::uint8_t>(x, y)[0]);
      ASSERT_EQ(pixel[1], beside.pixel<std::uint8_t>(x + 96, y)[1]);
      ASSERT_EQ(pixel[2], beside.pixel<std::uint8_t>(x + 96, y)[2]);
    }
  settings_.stereo.layout = StereoLayout::Anaglyph;
  const Status status = tryRender((folder_ / "a.exr").string(), {"color", "depth"});
  ASSERT_FALSE(status);
  EXPECT_THAT(status.error().message, HasSubstr("anaglyph"));
}

}  // namespace
}  // namespace lucerna::app
