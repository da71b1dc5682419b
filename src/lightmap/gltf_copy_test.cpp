#include "lightmap/gltf_copy.hpp"

#include <gmock/gmock.h>

#include <map>
#include <nlohmann/json.hpp>

#include "core/file.hpp"
#include "core/hash.hpp"
#include "core/test_folder.hpp"
#include "scene/gltf/gltf_structure.hpp"
#include "scene/load.hpp"

namespace lucerna::lightmap {
namespace {

namespace fs = std::filesystem;
using testing::IsEmpty;

// Every seventh triangle lies nowhere, the others in three maps by turns, no two alike. Objects
// that bend or are made of lines have no place.
Layout layoutFor(const scene::Scene& scene) {
  Layout layout{.side = 64, .maps = 3, .charts = 1, .objects = {}};
  std::uint32_t n = 0;
  for (const scene::Object& object : scene.objects) {
    auto& places = layout.objects.emplace_back(scene.meshes[object.mesh].triangleCount());
    for (TrianglePlace& place : places) {
      const auto x = static_cast<float>(n % 61), y = static_cast<float>(n / 61 % 61);
      place.map = n % 7 == 0 ? TrianglePlace::kNowhere : static_cast<std::int32_t>(n % 3);
      place.corners = {vec2(x, y), vec2(x + 1.f, y), vec2(x, y + 2.f)};
      ++n;
    }
  }
  return layout;
}

struct Triangle {
  std::array<vec3, 3> cornersW;
  std::array<vec2, 3> light;
  int map = -1;
};

void addTriangle(const scene::Scene& scene, const scene::Object& object, std::size_t triangle,
                 Triangle& made) {
  const scene::Mesh& mesh = scene.meshes[object.mesh];
  for (std::size_t k = 0; k < 3; ++k)
    made.cornersW[k] = vec3(scene.nodes[object.node].worldFromNode *
                            vec4(mesh.positions[mesh.indices[3 * triangle + k]], 1.f));
}

std::vector<const scene::Object*> byNode(const scene::Scene& scene) {
  std::vector<const scene::Object*> objects;
  for (const scene::Object& object : scene.objects) objects.push_back(&object);
  std::ranges::stable_sort(objects, {}, &scene::Object::node);
  return objects;
}

// Of the scene, as the file should order them: by node, object and map.
std::vector<Triangle> wanted(const scene::Scene& scene, const Layout& layout) {
  std::vector<Triangle> result;
  for (const scene::Object* object : byNode(scene)) {
    const auto& places = layout.objects[static_cast<std::size_t>(object - scene.objects.data())];
    std::vector<Triangle> own(places.size());
    for (std::size_t i = 0; i < places.size(); ++i) {
      addTriangle(scene, *object, i, own[i]);
      own[i].map = places[i].map;
      for (std::size_t k = 0; k < 3; ++k)
        own[i].light[k] = places[i].corners[k] / static_cast<float>(layout.side);
    }
    std::ranges::stable_sort(own, {}, &Triangle::map);
    result.insert(result.end(), own.begin(), own.end());
  }
  return result;
}

// Which map the material of an object read from the file has; MOZ_lightmap is not read.
std::map<std::uint32_t, int> mapsOf(const nlohmann::json& json) {
  std::map<std::uint32_t, int> maps;
  for (std::size_t i = 0; i < json["materials"].size(); ++i) {
    maps[static_cast<std::uint32_t>(i)] = -1;
    const nlohmann::json& material = json["materials"][i];
    if (!material.contains("/extensions/MOZ_lightmap"_json_pointer)) continue;
    const auto& texture =
        json["textures"][material["extensions"]["MOZ_lightmap"]["index"].get<std::size_t>()];
    const std::size_t source = texture["extensions"]["MOZ_texture_rgbe"]["source"];
    const std::string file = json["images"][source]["uri"];
    maps[static_cast<std::uint32_t>(i)] = file[6] - '0';  // map-00N.hdr
  }
  return maps;
}

std::vector<Triangle> found(const scene::Scene& scene, const nlohmann::json& json) {
  const std::map<std::uint32_t, int> maps = mapsOf(json);
  std::vector<Triangle> result;
  for (const scene::Object* object : byNode(scene)) {
    const scene::Mesh& mesh = scene.meshes[object->mesh];
    for (std::size_t i = 0; i < mesh.triangleCount(); ++i) {
      Triangle& triangle = result.emplace_back();
      addTriangle(scene, *object, i, triangle);
      triangle.map = maps.at(object->material);
      if (triangle.map < 0) continue;
      for (std::size_t k = 0; k < 3; ++k)
        triangle.light[k] = mesh.texCoords[1][mesh.indices[3 * i + k]];
    }
  }
  return result;
}

std::vector<scene::GltfLightmap> pictures() {
  return {{"map-000.hdr"}, {"map-001.hdr"}, {"map-002.hdr"}};
}

class GltfCopyOf : public testing::TestWithParam<const char*> {};

TEST_P(GltfCopyOf, HasEachTriangleAtItsPlaceInItsMap) {
  std::string name = GetParam();
  const fs::path scenes = fs::path(LUCERNA_SOURCE_DIR) / "../shared/scenes";
  if (!name.starts_with("builtin:")) {
    if (!fs::exists(scenes)) GTEST_SKIP() << "no ../shared/scenes beside this checkout";
    name = (scenes / name).string();
  }
  const Result<scene::Scene> scene = scene::loadScene(name);
  ASSERT_TRUE(scene) << scene.error().message;
  const Layout layout = layoutFor(*scene);
  const TestFolder folder;
  const auto copy = writeGltfCopy(*scene, layout, pictures(), {}, folder.path());
  ASSERT_TRUE(copy) << copy.error().message;
  for (const FileEntry& entry : copy->files)
    EXPECT_EQ(entry.hash, hashText16(hashBytes(*readFile(folder / entry.file)))) << entry.file;
  for (const auto& map : pictures()) ASSERT_TRUE(writeText(folder / map.file, ""));
  EXPECT_THAT(scene::GltfStructure::faultsOf(folder / "scene.gltf"), IsEmpty());
  const Result<scene::Scene> back = scene::loadScene((folder / "scene.gltf").string());
  ASSERT_TRUE(back) << back.error().message;

  const auto expected = wanted(*scene, layout);
  const auto got = found(*back, nlohmann::json::parse(*readText(folder / "scene.gltf")));
  ASSERT_EQ(got.size(), expected.size());
  const float close = 1e-6f * std::max(scene->boundsW().diagonal(), 1.f);
  for (std::size_t i = 0; i < got.size(); ++i) {
    ASSERT_EQ(got[i].map, expected[i].map) << i;
    for (std::size_t k = 0; k < 3; ++k) {
      ASSERT_LE(glm::distance(got[i].cornersW[k], expected[i].cornersW[k]), close) << i;
      if (got[i].map < 0) continue;
      ASSERT_EQ(got[i].light[k], expected[i].light[k]) << i;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, GltfCopyOf,
                         testing::Values("builtin:cornell", "builtin:atrium",
                                         "torcs_wheel-2/wheel-2.gltf",
                                         "gltf_features/VertexColorTest/VertexColorTest.gltf"));

TEST(GltfCopy, LeavesOutTheLightsThatAreInTheMaps) {
  Result<scene::Scene> scene = scene::loadScene("builtin:cornell");
  ASSERT_TRUE(scene);
  scene->lights.clear();
  for (const char* name : {"lamp", "switched", "sun"}) scene->lights.emplace_back().name = name;
  const TestFolder folder;
  const std::vector<std::uint32_t> baked = {0, 2};
  const Layout layout = layoutFor(*scene);
  ASSERT_TRUE(writeGltfCopy(*scene, layout, pictures(), baked, folder.path()));
  const auto json = nlohmann::json::parse(*readText(folder / "scene.gltf"));
  const auto& lights = json["extensions"]["KHR_lights_punctual"]["lights"];
  ASSERT_EQ(lights.size(), 1u);
  EXPECT_EQ(lights[0]["name"], "switched");
}

}  // namespace
}  // namespace lucerna::lightmap
