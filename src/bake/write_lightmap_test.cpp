#include "bake/write_lightmap.hpp"

#include <gmock/gmock.h>

#include <set>

#include "core/hash.hpp"
#include "core/test_folder.hpp"
#include "image/image_file.hpp"
#include "lightmap/lightmap.hpp"
#include "scene/gltf/gltf_structure.hpp"
#include "scene/load.hpp"

namespace lucerna::bake {
namespace {

namespace fs = std::filesystem;
using lightmap::FileEntry;
using testing::IsEmpty;

class WriteLightmap : public testing::Test {
 protected:
  void SetUp() override {
    Result<scene::Scene> scene = scene::loadScene("builtin:cornell");
    ASSERT_TRUE(scene);
    scene_ = std::move(*scene);
    write(10.f);
  }
  void write(float density) {
    BakeSettings settings;
    settings.density = density;
    settings.pack.side = 64;
    Result<Plan> plan = makePlan(scene_, settings);
    ASSERT_TRUE(plan) << plan.error().message;
    BakedLight baked = emptyLight(*plan);
    for (Image& map : baked.maps) map.pixel<std::uint16_t>(3, 5)[1] = halfFromFloat(200.f);
    Result<LightmapWriter> writer = LightmapWriter::begin(*plan, folder_.path());
    ASSERT_TRUE(writer) << writer.error().message;
    ASSERT_TRUE(writer->writeMaps(baked.maps, baked.texels));
    ASSERT_TRUE(writer->end());
  }
  std::set<std::string> names() const {
    std::set<std::string> result;
    for (const auto& entry : fs::directory_iterator(folder_.path()))
      result.insert(entry.path().filename().string());
    return result;
  }

  scene::Scene scene_;
  TestFolder folder_;
};

TEST_F(WriteLightmap, TheFolderHoldsWhatTheManifestNamesAndNothingElse) {
  write(4.f);  // fewer maps: those of the first time go
  const Result<lightmap::Lightmap> read = lightmap::readLightmap(folder_.path());
  ASSERT_TRUE(read) << read.error().message;
  std::set<std::string> named{"manifest.json", read->manifest.layout.file};
  for (const auto& map : read->manifest.maps) named.insert(map.master.file);
  for (const FileEntry& entry : read->manifest.gltf) {
    named.insert(entry.file);
    EXPECT_TRUE(lightmap::readEntry(folder_.path(), entry)) << entry.file;
  }
  EXPECT_TRUE(named.contains("scene.gltf") && named.contains("map-000.hdr"));
  EXPECT_EQ(names(), named);
}

TEST_F(WriteLightmap, TheCopyIsTheSceneWithItsMaps) {
  EXPECT_THAT(scene::GltfStructure::faultsOf(folder_ / "scene.gltf"), IsEmpty());
  const Result<scene::Scene> back = scene::loadScene((folder_ / "scene.gltf").string());
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_EQ(back->triangleCount(), scene_.triangleCount());
  const Result<Image> map = readImage(folder_ / "map-000.hdr");
  ASSERT_TRUE(map);
  EXPECT_EQ(map->width(), 64);
  EXPECT_EQ(map->pixel<float>(3, 5)[1], 200.f);
}

}  // namespace
}  // namespace lucerna::bake
