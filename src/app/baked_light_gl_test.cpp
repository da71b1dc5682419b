// --lightmap from the folder to the picture, with folders made by hand.
#include "app/baked_light.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "app/frame.hpp"
#include "app/frame_writer.hpp"
#include "core/file.hpp"
#include "core/hash.hpp"
#include "core/test_folder.hpp"
#include "image/image_file.hpp"
#include "lightmap/scene_hash.hpp"
#include "scene/load.hpp"

namespace lucerna::app {
namespace {

using testing::HasSubstr;

constexpr int kSide = 64, kCell = 8;  // texels
// Irradiance all over each map.
constexpr std::array kMaps = {vec3(1.f, 2.f, 4.f), vec3(8.f, 2.f, 0.5f)};

// Every triangle in a square of its own, objects in turn in the one map and the other.
lightmap::Layout layoutOf(const scene::Scene& scene) {
  lightmap::Layout layout{.side = kSide, .maps = 2, .charts = 0, .objects = {}};
  std::array<int, 2> used{};
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const std::size_t map = i % 2;
    auto& places = layout.objects.emplace_back();
    for (std::size_t t = 0; t < scene.meshes[scene.objects[i].mesh].triangleCount(); ++t) {
      const int cell = used[map]++;
      constexpr int kCells = kSide / kCell;
      EXPECT_LT(cell, kCells * kCells);
      const vec2 first = vec2(cell % kCells, cell / kCells) * static_cast<float>(kCell) + 1.f;
      places.push_back({.map = static_cast<std::int32_t>(map),
                        .chart = static_cast<std::uint32_t>(layout.charts++),
                        .corners = {first, first + vec2(6, 0), first + vec2(0, 6)}});
    }
  }
  return layout;
}

class BakedFolderTest : public testing::Test {
 protected:
  void SetUp() override {
    settings_.scene = "builtin:cornell";
    settings_.size = {64, 64};
    settings_.pipeline = "lightmapped";
    settings_.lightmap = folder_.path().string();
    auto scene = scene::loadScene(settings_.scene);
    ASSERT_TRUE(scene);
    scene_ = std::move(scene).value();
    manifest_.scene = scene_.name;
    manifest_.sceneHash = lightmap::hashText16(0);
    manifest_.settings = "{}";
    manifest_.processor = "none";
    manifest_.side = kSide;
    manifest_.density = 1.f;
    for (std::uint32_t i = 0; i < scene_.lights.size(); ++i)
      manifest_.lights.push_back({.name = scene_.lights[i].name, .group = "", .light = i});
    write(layoutOf(scene_));
  }

  void write(const lightmap::Layout& layout) {
    const Bytes bytes = toBytes(layout);
    ASSERT_TRUE(writeFile(folder_ / "layout.bin", bytes));
    manifest_.layout = {"layout.bin", lightmap::hashText16(hashBytes(bytes))};
    manifest_.maps.clear();
    for (std::size_t map = 0; map < kMaps.size(); ++map) {
      Image image(kSide, kSide, 3, ComponentType::Half);
      for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x)
          for (int c = 0; c < 3; ++c)
            image.pixel<std::uint16_t>(x, y)[c] = halfFromFloat(kMaps[map][c]);
      const std::string name = fmt::format("map-{:03}.exr", map);
      ASSERT_TRUE(writeImage(folder_ / name, image));
      const auto file = readFile(folder_ / name);
      ASSERT_TRUE(file);
      manifest_.maps.push_back({.master = {name, lightmap::hashText16(hashBytes(*file))},
                                .encoded = {},
                                .largest = kMaps[map],
                                .texels = 0});
    }
    writeManifest();
  }

  // A group of all lights that the manifest names, and its light: 1 on the first tile.
  void addLamps() {
    for (lightmap::LightEntry& light : manifest_.lights) light.group = "lamps";
    for (scene::Light& light : scene_.lights) light.group = "lamps";
    lightmap::Patch patch{.group = "lamps", .side = kSide, .maps = static_cast<int>(kMaps.size())};
    patch.tiles.tiles.push_back({.scale = 1.f / 65535.f, .mask = ~std::uint64_t{0}});
    patch.tiles.values.assign(lightmap::kTileTexels, 65535);
    const Bytes bytes = toBytes(patch);
    ASSERT_TRUE(writeFile(folder_ / "patch-000.bin", bytes));
    manifest_.patches.push_back({.group = "lamps",
                                 .patch = {"patch-000.bin", lightmap::hashText16(hashBytes(bytes))},
                                 .form = "tiles"});
    writeManifest();
  }

  void writeManifest() { ASSERT_TRUE(writeText(folder_ / "manifest.json", toJson(manifest_))); }

  // The layers of the picture by name; "": its colour.
  std::map<std::string, Image> render(const std::string& pipeline,
                                      std::vector<std::string> wanted) {
    settings_.pipeline = pipeline;
    const OutputSettings output{.path = folder_ / "picture.exr",
                                .layers = std::move(wanted),
                                .exrType = ComponentType::F32};
    auto writer = FrameWriter::create(output, settings_);
    EXPECT_TRUE(writer);
    auto session = openSession(settings_, writer->layers());
    EXPECT_TRUE(session) << session.error().message;
    const Status drawn =
        runFrame(**session, nullptr, [&](Session& s, int view, const gpu::Texture& texture) {
          return writer->write(s, view, texture);
        });
    EXPECT_TRUE(drawn) << drawn.error().message;
    EXPECT_EQ((*session)->glMessages, 0);
    std::map<std::string, Image> images;
    const auto layers = readExrLayers(writer->written().front());
    EXPECT_TRUE(layers);
    for (const ExrLayer& layer : *layers)
      images[layer.name] = converted(layer.image, ComponentType::F32, 3);
    return images;
  }

  // To stderr, as the lightmap is taken.
  std::string said() const {
    scene::Scene scene = scene_;
    testing::internal::CaptureStderr();
    EXPECT_TRUE(takeBakedLight(scene, settings_));
    return testing::internal::GetCapturedStderr();
  }

  Error errorOf() {
    scene::Scene scene = scene_;
    const auto maps = takeBakedLight(scene, settings_);
    return maps ? Error{.kind = ErrorKind::Failed, .message = "none"} : maps.error();
  }

  TestFolder folder_;
  RenderSettings settings_;
  scene::Scene scene_;
  lightmap::Manifest manifest_;
};

// The irradiance that the colour of a pixel tells.
vec3 irradianceAt(const Image& color, const Image& albedo, int x, int y) {
  vec3 result(0.f);
  for (int c = 0; c < 3; ++c)
    result[c] = color.pixel<float>(x, y)[c] * kPi / std::max(albedo.pixel<float>(x, y)[c], 1e-3f);
  return result;
}

TEST_F(BakedFolderTest, EveryPixelShowsItsMapAndNoOtherLight) {
  const Image albedo = render("lightmapped", {"albedo"}).at("albedo");
  for (const char* pipeline : {"lightmapped", "forward"}) {
    const Image color = render(pipeline, {}).at("");
    std::array<int, 2> pixels{};
    int others = 0;
    for (int y = 0; y < 64; ++y)
      for (int x = 0; x < 64; ++x) {
        if (albedo.pixel<float>(x, y)[1] == 0.f) continue;  // beside the box
        const vec3 found = irradianceAt(color, albedo, x, y);
        const auto shows = [&](vec3 map) { return glm::distance(found / map, vec3(1)) < 0.06f; };
        if (shows(kMaps[0]))
          ++pixels[0];
        else if (shows(kMaps[1]))
          ++pixels[1];
        else
          ++others;
      }
    EXPECT_GT(pixels[0], 500) << pipeline;
    EXPECT_GT(pixels[1], 500) << pipeline;
    EXPECT_LT(others, 30) << pipeline;  // the lamp
  }
}

TEST_F(BakedFolderTest, AmbientSharesOfBakedLightsStay) {
  ASSERT_FALSE(scene_.lights.empty());
  scene_.lights[0].ambientIntensity = 0.25f;
  scene_.ambient = vec3(0.5f);
  const vec3 share = scene::placeLights(scene_)[0].ambient;
  ASSERT_GT(share.x, 0.f);
  ASSERT_TRUE(takeBakedLight(scene_, settings_));
  EXPECT_FALSE(scene_.lights[0].on);
  EXPECT_EQ(scene_.ambient, vec3(0.5f) + share);
}

TEST_F(BakedFolderTest, AGroupThatIsOffGivesNoAmbientLightEither) {
  addLamps();
  settings_.lightsOff = {"lamps"};
  scene_.lights[0].ambientIntensity = 0.25f;
  scene_.ambient = vec3(0.5f);
  ASSERT_TRUE(takeBakedLight(scene_, settings_));
  EXPECT_EQ(scene_.ambient, vec3(0.5f));

  settings_.lightsOff = {"lamp"};
  const Error error = errorOf();
  EXPECT_EQ(error.kind, ErrorKind::Usage);
  EXPECT_THAT(error.message, HasSubstr("'lamp' is no group of lights in this lightmap (did you "
                                       "mean 'lamps'?); wanted one of lamps"));
  settings_.lightsOff = {"always-on"};
  EXPECT_THAT(errorOf().message, HasSubstr("what is always on cannot be switched off: its light is "
                                           "in the maps, not in a patch; wanted one of lamps"));
}

TEST_F(BakedFolderTest, AGroupStartsAsTheSceneHasIt) {
  addLamps();
  const auto redOfFirst = [&](bool on, std::vector<std::string> off) {
    scene::Scene scene = scene_;
    for (scene::Light& light : scene.lights) light.on = on;
    settings_.lightsOff = std::move(off);
    const auto maps = takeBakedLight(scene, settings_);
    EXPECT_TRUE(maps) << maps.error().message;
    return maps ? maps->front().pixel<float>(0, 0)[0] : 0.f;
  };
  EXPECT_FLOAT_EQ(redOfFirst(true, {}), kMaps[0].x + 1.f);
  EXPECT_FLOAT_EQ(redOfFirst(true, {"lamps"}), kMaps[0].x);
  EXPECT_FLOAT_EQ(redOfFirst(false, {}), kMaps[0].x);
}

TEST_F(BakedFolderTest, SaysWhichLightsHaveChanged) {
  manifest_.lights[0].hash = lightmap::hashText16(lightmap::lightHash(scene_, 0));
  writeManifest();
  EXPECT_EQ(said(), "");
  scene_.lights[0].color.x *= 0.5f;
  EXPECT_THAT(said(), HasSubstr("1 of the 1 lights of the lightmap have changed"));
  scene_.lights[0].name = "another";
  EXPECT_THAT(errorOf().message, HasSubstr("light 0 of"));
  EXPECT_THAT(errorOf().message, HasSubstr("is 'another', always-on, and when"));
}

TEST_F(BakedFolderTest, SaysHowManyObjectsHaveMoved) {
  for (std::uint32_t i = 0; i < scene_.objects.size(); ++i)
    manifest_.objects.push_back({.node = scene_.nodes[scene_.objects[i].node].name,
                                 .object = i,
                                 .charts = 0,
                                 .maps = {},
                                 .hash = lightmap::hashText16(lightmap::placeHash(scene_, i))});
  writeManifest();
  EXPECT_EQ(said(), "");
  const scene::Scene baked = scene_;
  const auto saidOf = [&](auto change) {
    scene_ = baked;
    change(scene_.nodes[scene_.objects[1].node]);
    scene::updateTransforms(scene_);
    return said();
  };
  const std::string warning = fmt::format(
      "1 of the {} objects of the lightmap have been moved, turned or scaled since it "
      "was baked, '{}' the first; light and shadows are those of where they stood: "
      "bake it again",
      scene_.objects.size(), manifest_.objects[1].node);
  EXPECT_THAT(saidOf([](scene::Node& node) { node.translation.x += 1e-3f; }), HasSubstr(warning));
  EXPECT_THAT(saidOf([](scene::Node& node) { node.scale.y *= 1.01f; }), HasSubstr(warning));
  EXPECT_THAT(saidOf([](scene::Node& node) {
                node.rotation = glm::angleAxis(0.01f, vec3(0, 1, 0)) * node.rotation;
              }),
              HasSubstr(warning));
  // An animation that --animation chooses moves what it moves; nothing else.
  settings_.animation = "none";
  EXPECT_THAT(said(), HasSubstr(warning));
  scene::AnimationChannel channel;
  channel.node = scene_.objects[1].node;
  scene_.animations.push_back({.name = "turn", .channels = {channel}, .playing = false});
  EXPECT_EQ(said(), "");
  settings_.animation.clear();
  EXPECT_THAT(said(), HasSubstr(warning));
  for (lightmap::ObjectEntry& object : manifest_.objects) object.hash.clear();  // not known
  writeManifest();
  EXPECT_EQ(said(), "");
  manifest_.objects.push_back({.node = "moon", .object = 700, .charts = 0, .maps = {}});
  writeManifest();
  EXPECT_THAT(errorOf().message, HasSubstr("the lightmap knows object 700, 'moon', and"));
}

TEST_F(BakedFolderTest, SaysWhatDoesNotFit) {
  settings_.lightsOff = {"lamps"};
  EXPECT_THAT(errorOf().message, HasSubstr("none that could be switched"));
  settings_.lightsOff.clear();
  manifest_.lights.push_back({.name = "moon", .group = "", .light = 7});
  writeManifest();
  EXPECT_EQ(errorOf().kind, ErrorKind::Input);
  EXPECT_THAT(errorOf().message, HasSubstr("light 7, 'moon'"));
  scene_.objects.pop_back();
  EXPECT_EQ(errorOf().kind, ErrorKind::Input);
  EXPECT_THAT(errorOf().message, HasSubstr("bake it again"));
}

}  // namespace
}  // namespace lucerna::app
