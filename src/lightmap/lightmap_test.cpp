#include "lightmap/lightmap.hpp"

#include <gtest/gtest.h>

#include "core/file.hpp"
#include "core/hash.hpp"
#include "core/test_folder.hpp"
#include "image/image_file.hpp"
#include "lightmap/place.hpp"
#include "scene/load.hpp"

namespace lucerna::lightmap {
namespace {

// Two triangles of an object, each in a map of its own.
Layout smallLayout() {
  Layout layout{.side = 8, .maps = 2, .charts = 2, .objects = {{}, {}}};
  layout.objects[1] = {{.map = 0, .chart = 0, .corners = {vec2(0, 0), vec2(3, 0), vec2(0, 3)}},
                       {.map = 1, .chart = 1, .corners = {vec2(1, 1), vec2(8, 1), vec2(1, 8)}}};
  return layout;
}

TEST(Layout, BytesAndBack) {
  const Layout layout = smallLayout();
  const Result<Layout> back = layoutFrom(toBytes(layout), "layout.bin");
  ASSERT_TRUE(back);
  EXPECT_EQ(back->side, 8);
  EXPECT_EQ(back->maps, 2);
  ASSERT_EQ(back->objects.size(), 2u);
  ASSERT_EQ(back->objects[1].size(), 2u);
  EXPECT_EQ(back->objects[1][1].map, 1);
  EXPECT_EQ(back->objects[1][1].corners[1], vec2(8, 1));
}

TEST(Layout, EveryMissingByteIsFoundAndNoFlippedOneIsFollowed) {
  const Bytes bytes = toBytes(smallLayout());
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_FALSE(layoutFrom(std::span(bytes).first(size), "layout.bin")) << size;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    Bytes flipped = bytes;
    flipped[i] ^= std::byte{0x80};
    const Result<Layout> read = layoutFrom(flipped, "layout.bin");
    if (!read) continue;
    for (const auto& triangles : read->objects)
      for (const TrianglePlace& place : triangles) {
        EXPECT_LT(place.map, read->maps);
        for (const vec2 p : place.corners) EXPECT_LE(std::max(p.x, p.y), 8.f);
      }
  }
}

Manifest smallManifest() {
  return {.scene = "builtin:cornell",
          .sceneHash = hashText16(1),
          .geometryHash = hashText16(8),
          .settings = R"({"preset": "standard"})",
          .processor = "avx2",
          .side = 8,
          .density = 2.5f,
          .layout = {"layout.bin", hashText16(2)},
          .maps = {{.master = {"map-000.exr", hashText16(3)},
                    .encoded = {{"map-000.ktx2", hashText16(4)}},
                    .largest = {1, 2, 3},
                    .texels = 17}},
          .patches = {{.group = "lamps",
                       .patch = {"patch-000.bin", hashText16(5)},
                       .form = "triangles",
                       .bytes = 10,
                       .otherBytes = 20}},
          .objects = {{
              .node = "box",
              .object = 3,
              .charts = 6,
              .maps = {0},
              .hash = hashText16(10),
          }},
          .lights = {{.name = "lamp", .group = "lamps", .light = 4, .hash = hashText16(9)}},
          .gltf = {{"scene.gltf", hashText16(6)}, {"scene.bin", hashText16(7)}}};
}

TEST(Manifest, OfVeryManyLightsIsRead) {
  Manifest manifest = smallManifest();
  const std::string name(600, 'l');  // so that fewer do
  manifest.lights.resize(110'000, {.name = name, .group = "", .light = 4});
  const TestFolder folder;
  const std::string text = toJson(manifest);
  ASSERT_GT(text.size(), std::size_t{64} << 20);
  ASSERT_TRUE(writeText(folder / "manifest.json", text));
  const Result<Manifest> back = readManifest(folder.path());
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_EQ(back->lights.size(), manifest.lights.size());
}

TEST(Manifest, TextAndBack) {
  const Result<Manifest> back = manifestFrom(toJson(smallManifest()), "manifest.json");
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_EQ(back->scene, "builtin:cornell");
  EXPECT_EQ(back->geometryHash, hashText16(8));
  EXPECT_EQ(back->side, 8);
  EXPECT_EQ(back->density, 2.5f);
  ASSERT_EQ(back->maps.size(), 1u);
  EXPECT_EQ(back->maps[0].encoded.at(0).file, "map-000.ktx2");
  EXPECT_EQ(back->maps[0].largest, vec3(1, 2, 3));
  EXPECT_EQ(back->maps[0].texels, 17u);
  EXPECT_EQ(back->patches.at(0).form, "triangles");
  EXPECT_EQ(back->patches.at(0).otherBytes, 20u);
  EXPECT_EQ(back->objects.at(0).maps, std::vector<int>{0});
  EXPECT_EQ(back->objects.at(0).hash, hashText16(10));
  EXPECT_EQ(back->lights.at(0).light, 4u);
  EXPECT_EQ(back->lights.at(0).hash, hashText16(9));
  ASSERT_EQ(back->gltf.size(), 2u);
  EXPECT_EQ(back->gltf[0].file, "scene.gltf");
  EXPECT_EQ(back->gltf[1].hash, hashText16(7));
}

TEST(Manifest, WhatHasNoNameComesBackWithoutOne) {
  Manifest manifest = smallManifest();
  manifest.processor.clear();
  manifest.objects[0].node.clear();
  manifest.objects[0].hash.clear();  // as older ones
  manifest.lights[0] = {.name = "", .group = "", .light = 4};
  const Result<Manifest> back = manifestFrom(toJson(manifest), "manifest.json");
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_EQ(back->objects.at(0).node, "");
  EXPECT_EQ(back->objects.at(0).hash, "");
  EXPECT_EQ(back->lights.at(0).group, "");
}

TEST(Manifest, NoOtherByteIsTakenForIt) {
  const std::string text = toJson(smallManifest());
  for (std::size_t i = 0; i < text.size(); ++i) {
    std::string without = text;
    without.erase(i, 1);
    std::string flipped = text;
    flipped[i] = static_cast<char>(flipped[i] ^ 1);
    for (const std::string& damaged : {without, flipped, text.substr(0, i)}) {
      const Result<Manifest> read = manifestFrom(damaged, "manifest.json");
      if (!read) continue;
      EXPECT_EQ(toJson(*read), text) << i << ": only white space differs";
    }
  }
}

// What is said of a text that is no whole manifest.
std::string faultOf(const std::string& text) {
  const Result<Manifest> read = manifestFrom(text, "m/manifest.json");
  EXPECT_FALSE(read);
  if (read) return "no fault";
  EXPECT_EQ(read.error().kind, ErrorKind::Input);
  return read.error().message;
}

TEST(Manifest, OfSomethingElseIsOneLine) {
  const std::string wanted =
      "m/manifest.json: is not a lightmap's manifest: found no \"lucerna\": \"lightmap/1\"; wanted "
      "the folder of a finished `lucerna bake`";
  for (const char* text : {"{\"name\": \"A page\", \"icons\": []}", "[1, 2]", "<html>", "",
                           "{\"lucerna\": \"scene/1\", \"lights\": []}", "{\"lucerna\": 1}"})
    EXPECT_EQ(faultOf(text), wanted) << text;
  std::string newer = toJson(smallManifest());
  newer.replace(newer.find("lightmap/1"), 10, "lightmap/9");
  EXPECT_EQ(faultOf(newer),
            "m/manifest.json: is of another version of this program: found \"lucerna\": "
            "\"lightmap/9\", wanted \"lightmap/1\"; bake the scene again");
}

TEST(Manifest, DamageIsOneLineThatSaysSo) {
  const std::string text = toJson(smallManifest());
  std::string damaged = text;
  damaged[text.find("\"density\"") + 3] ^= '\1';  // a key that is unknown, and one that lacks
  EXPECT_TRUE(
      faultOf(damaged).starts_with("m/manifest.json: is damaged or was changed: its hash is "))
      << faultOf(damaged);
  EXPECT_EQ(faultOf(damaged).find('\n'), std::string::npos);
  damaged = text;
  damaged[text.find("\"density\"") + 3] ^= '\x80';
  const std::string said = faultOf(damaged);
  EXPECT_TRUE(said.starts_with("m/manifest.json:")) << said;
  EXPECT_TRUE(
      said.ends_with(": found the byte 0xEE, wanted UTF-8; the manifest is damaged: bake the "
                     "scene again"))
      << said;
}

TEST(Manifest, ByHandNeedsNoHash) {
  std::string text = toJson(smallManifest());
  const std::size_t at = text.rfind(",\n \"hash\"");
  ASSERT_NE(at, std::string::npos);
  text.replace(at, std::string::npos, "}");
  text.replace(text.find("2.5"), 3, "3.5");
  const Result<Manifest> read = manifestFrom(text, "manifest.json");
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->density, 3.5f);
}

TEST(Manifest, SaysEveryFault) {
  Manifest manifest = smallManifest();
  manifest.layout.file = "../layout.bin";
  manifest.maps[0].master.hash = "none";
  manifest.gltf[0].file = "a/scene.gltf";
  const Result<Manifest> read = manifestFrom(toJson(manifest), "manifest.json");
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().kind, ErrorKind::Input);
  EXPECT_NE(read.error().message.find("beside the manifest"), std::string::npos);
  EXPECT_NE(read.error().message.find("hexadecimal"), std::string::npos);
  EXPECT_NE(read.error().message.find("/gltf/0/file"), std::string::npos);
}

// A folder with everything in place.
class BakedFolder : public ::testing::Test {
 protected:
  void SetUp() override {
    Manifest manifest = smallManifest();
    manifest.patches.clear();
    Layout layout = smallLayout();
    layout.maps = 1;
    layout.objects[1].pop_back();
    layout.charts = 1;
    const Bytes bytes = toBytes(layout);
    ASSERT_TRUE(writeFile(path("layout.bin"), bytes));
    manifest.layout.hash = hashText16(hashBytes(bytes));
    Image map(8, 8, 3, ComponentType::Half);
    map.pixel<std::uint16_t>(2, 3)[1] = halfFromFloat(7.f);
    ASSERT_TRUE(writeImage(path("map-000.exr"), map));
    const Result<Bytes> file = readFile(path("map-000.exr"));
    ASSERT_TRUE(file);
    manifest.maps[0].master.hash = hashText16(hashBytes(*file));
    ASSERT_TRUE(writeText(path("manifest.json"), toJson(manifest)));
  }
  std::filesystem::path path(const char* name) const { return folder_.path() / name; }
  std::filesystem::path folder() const { return folder_.path(); }

 private:
  TestFolder folder_;
};

TEST_F(BakedFolder, IsReadWhole) {
  const Result<Lightmap> read = readLightmap(folder());
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->maps.at(0).pixel<float>(2, 3)[1], 7.f);
}

TEST_F(BakedFolder, AFlippedByteIsNamedAndNeverUsed) {
  Result<Bytes> bytes = readFile(path("map-000.exr"));
  ASSERT_TRUE(bytes);
  bytes->back() ^= std::byte{1};
  ASSERT_TRUE(writeFile(path("map-000.exr"), *bytes));
  const Result<Lightmap> read = readLightmap(folder());
  ASSERT_FALSE(read);
  EXPECT_NE(read.error().message.find("map-000.exr: is damaged"), std::string::npos);
}

TEST(PlaceInMaps, ObjectsThatShareAMeshGetTheirOwn) {
  Result<scene::Scene> scene = scene::loadScene("builtin:cornell");
  ASSERT_TRUE(scene);
  // A second object of the first one's mesh.
  scene->objects.push_back(scene->objects[0]);
  Layout layout{.side = 16, .maps = 1, .charts = 1, .objects = {}};
  layout.objects.resize(scene->objects.size());
  const std::size_t triangles = scene->meshes[scene->objects[0].mesh].triangleCount();
  layout.objects[0].assign(triangles, {.map = 0, .corners = {vec2(0, 0), vec2(8, 0), vec2(0, 8)}});
  layout.objects.back().assign(triangles,
                               {.map = 0, .corners = {vec2(8, 8), vec2(16, 8), vec2(8, 16)}});
  const std::vector<vec3> before = scene->meshes[scene->objects[0].mesh].positions;
  const std::vector<std::uint32_t> indices = scene->meshes[scene->objects[0].mesh].indices;
  placeInMaps(*scene, layout);
  ASSERT_NE(scene->objects[0].mesh, scene->objects.back().mesh);
  const scene::Mesh& first = scene->meshes[scene->objects[0].mesh];
  const scene::Mesh& last = scene->meshes[scene->objects.back().mesh];
  ASSERT_EQ(first.indices.size(), indices.size());
  for (std::size_t i = 0; i < indices.size(); ++i) {
    EXPECT_EQ(first.positions[first.indices[i]], before[indices[i]]);
    EXPECT_EQ(last.positions[last.indices[i]], before[indices[i]]);
  }
  EXPECT_EQ(first.lightmap[first.indices[1]], vec3(0.5f, 0.f, 0.f));
  EXPECT_EQ(last.lightmap[last.indices[1]], vec3(1.f, 0.5f, 0.f));
}

}  // namespace
}  // namespace lucerna::lightmap
