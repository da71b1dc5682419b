#include "bake/own_files.hpp"

#include <gmock/gmock.h>

#include <atomic>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>

#include "bake/assemble.hpp"
#include "bake/write_lightmap.hpp"
#include "core/file.hpp"
#include "core/test_folder.hpp"
#include "scene/load.hpp"

namespace lucerna::bake {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

class OwnFiles : public testing::Test {
 protected:
  void put(const std::string& name, const std::string& text = "") const {
    fs::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name) << text;
  }
  void putManifest() const {
    lightmap::Manifest manifest;
    manifest.scene = manifest.sceneHash = "a";
    manifest.side = 16;
    manifest.layout = {.file = "layout.bin", .hash = std::string(16, '0')};
    manifest.maps.emplace_back().master = {.file = "map-000.exr", .hash = std::string(16, '0')};
    put("manifest.json", lightmap::toJson(manifest));
    put("layout.bin");
    put("map-000.exr");
  }
  std::string fault() const {
    const Status status = checkNoOthers(folder_.path());
    return status ? "" : status.error().message;
  }
  std::set<std::string> names() const {
    std::set<std::string> result;
    for (const auto& entry : fs::recursive_directory_iterator(folder_.path()))
      result.insert(entry.path().lexically_relative(folder_.path()).string());
    return result;
  }
  static Plan planOf(const char* name, float density, int side = 64) {
    static std::vector<std::unique_ptr<scene::Scene>> scenes;
    Result<scene::Scene> scene = scene::loadScene(name);
    EXPECT_TRUE(scene);
    scenes.push_back(std::make_unique<scene::Scene>(std::move(*scene)));
    BakeSettings settings;
    settings.density = density;
    settings.pack.side = side;
    Result<Plan> plan = makePlan(*scenes.back(), settings);
    EXPECT_TRUE(plan);
    return std::move(*plan);
  }

  TestFolder folder_;
};

TEST_F(OwnFiles, AFolderOfOthersIsRefused) {
  EXPECT_EQ(fault(), "");
  put(".map-000.tmp-12-3.exr");
  put("work/.bake.tmp-12-3.json");
  EXPECT_EQ(fault(), "");
  for (const char* name : {"notes.txt", "map-000.exr", "layout.bin", ".map-000.tmp-exr",
                           ".notes.tmp-1-1.txt", "work/notes.txt", "work/shard-1.log"}) {
    put(name);
    EXPECT_THAT(fault(), AllOf(HasSubstr("none of a lightmap"), HasSubstr(name)));
    fs::remove(folder_ / name);
  }
  EXPECT_EQ(fault(), "");
}

TEST_F(OwnFiles, ALightmapsFolderMayHoldWhatIsNotNamedLikeIt) {
  putManifest();
  put("notes.txt");
  put("maps/map-001.exr");
  EXPECT_EQ(fault(), "");
  for (const char* name : {"map-001.exr", "tex-777.png", "patch-000.bin", "work/notes.txt"}) {
    put(name);
    EXPECT_THAT(fault(), AllOf(HasSubstr("none of a lightmap"), HasSubstr(name)));
    fs::remove(folder_ / name);
  }
  fs::create_directories(folder_ / "scene.gltf");
  EXPECT_THAT(fault(), HasSubstr("'scene.gltf'"));
}

TEST_F(OwnFiles, OfADamagedManifestNothingIsKnown) {
  putManifest();
  std::string text = *readText(folder_ / "manifest.json");
  text[text.find("map-000")] = 'n';
  put("manifest.json", text);
  EXPECT_THAT(fault(), AllOf(HasSubstr("damaged"), HasSubstr("another folder")));
  // One that was written after the list names it is known all the same.
  fs::remove(folder_ / "manifest.json");
  fs::remove(folder_ / "map-000.exr");
  fs::remove(folder_ / "layout.bin");
  ASSERT_TRUE(claimFiles(planOf("builtin:cornell", 4.f), folder_.path()));
  put("manifest.json", text);
  EXPECT_EQ(fault(), "");
}

// As other tools write JSON.
TEST_F(OwnFiles, AManifestIsKnownHoweverItIsSpaced) {
  putManifest();
  const auto manifest = nlohmann::ordered_json::parse(*readText(folder_ / "manifest.json"));
  for (const int indent : {-1, 0, 8}) {
    put("manifest.json", manifest.dump(indent));
    EXPECT_EQ(fault(), "");
  }
  put("manifest.json", manifest.dump() + "]");
  EXPECT_THAT(fault(), AllOf(HasSubstr("damaged"), HasSubstr("another folder")));
}

TEST_F(OwnFiles, OfADamagedListTheReaderSaysWhatIsWrong) {
  putManifest();
  for (const auto& [text, found] :
       {std::pair("", "unfinished.json"), std::pair("{\"lucerna\": \"unfinished/1\"}", "files")}) {
    put("unfinished.json", text);
    EXPECT_THAT(fault(),
                AllOf(HasSubstr("unfinished.json:"), HasSubstr(found), HasSubstr("remove it"),
                      HasSubstr("another folder"), testing::Not(HasSubstr("none of a lightmap"))));
  }
}

// Shards that start together write the order beside each other, and who writes a lightmap removes
// old files.
TEST_F(OwnFiles, WhatVanishesMeanwhileIsNotInTheWay) {
  constexpr int kFiles = 3000;
  nlohmann::ordered_json list{{"lucerna", "unfinished/1"}, {"files", nlohmann::json::array()}};
  for (int i = 0; i < kFiles; ++i) list["files"].push_back(fmt::format("map-{:03}.exr", i));
  putManifest();
  put("unfinished.json", list.dump());
  put("work/bake.json");
  std::atomic<bool> over{false};
  const std::jthread other([&] {
    for (int i = 1; i < kFiles; ++i) {
      for (const std::string& name :
           {fmt::format("work/.bake.tmp-1-{}.json", i), fmt::format("map-{:03}.exr", i)}) {
        put(name);
        fs::remove(folder_ / name);
      }
    }
    over = true;
  });
  std::string found;
  while (!over && found.empty()) found = fault();
  EXPECT_EQ(found, "");
}

TEST_F(OwnFiles, TheLockIsABakesAndStaysWithWhoHasIt) {
  putManifest();
  put("work/bake.lock");
  put("work/bake.json");
  EXPECT_EQ(fault(), "");
  removeWork(folder_.path());
  EXPECT_THAT(names(), AllOf(Contains("work/bake.lock"), testing::Not(Contains("work/bake.json"))));
}

TEST_F(OwnFiles, WhatIsClaimedGoesUnlessItIsNamed) {
  putManifest();
  put("map-000.hdr");
  EXPECT_FALSE(claimFiles(planOf("builtin:cornell", 10.f), folder_.path()));  // not in the manifest
  EXPECT_FALSE(fs::exists(folder_ / "unfinished.json"));
  fs::remove(folder_ / "map-000.hdr");
  ASSERT_TRUE(claimFiles(planOf("builtin:cornell", 10.f), folder_.path()));  // several maps
  for (const char* name : {"map-000.hdr", "map-001.exr", "notes.txt", "tex-777.png"}) put(name);
  EXPECT_THAT(fault(), HasSubstr("tex-777.png"));
  fs::remove(folder_ / "tex-777.png");
  EXPECT_EQ(fault(), "");
  // Claimed again, by a bake of one map, what the first has written is known still.
  ASSERT_TRUE(claimFiles(planOf("builtin:cornell", 1.f), folder_.path()));
  put("tex-777.png");  // put there while it bakes
  put("work/bake.json");
  put("work/shard-1-of-1.log");
  put(".map-001.tmp-1-2.exr");
  removeWork(folder_.path());
  EXPECT_THAT(names(), ElementsAre("layout.bin", "manifest.json", "map-000.exr", "notes.txt",
                                   "tex-777.png"));
}

TEST_F(OwnFiles, WorkKeepsWhatIsNoBakes) {
  putManifest();
  put("work/bake.json");
  put("work/shard-3-of-5.log");
  put("work/.bake.tmp-1-0.json");
  put("work/thesis.log");
  removeWork(folder_.path());
  EXPECT_THAT(names(),
              ElementsAre("layout.bin", "manifest.json", "map-000.exr", "work", "work/thesis.log"));
}

TEST_F(OwnFiles, AllThatABakeWritesIsClaimed) {
  Plan plan = planOf("builtin:nightcity", 0.1f, 1024);
  plan.settings.encodings = {Encoding::Rgb9e5, Encoding::Bc6h, Encoding::Png};
  ASSERT_TRUE(claimFiles(plan, folder_.path()));
  const std::string claimed = *readText(folder_ / "unfinished.json");
  const BakedLight dark = emptyLight(plan);
  Result<LightmapWriter> writer = LightmapWriter::begin(plan, folder_.path());
  ASSERT_TRUE(writer) << writer.error().message;
  ASSERT_TRUE(writer->writeMaps(dark.maps, dark.texels));
  const auto groups = static_cast<std::uint32_t>(plan.groups.size());
  Progress progress("making patches", groups);
  ASSERT_TRUE(writer->writePatches(dark, {.first = 1, .last = groups}, progress));
  ASSERT_TRUE(writer->end());
  const auto all = names();
  EXPECT_THAT(all,
              AllOf(Contains("map-000.png"), Contains("patch-000.bin"), Contains("tex-000.png")));
  for (const std::string& name : all) EXPECT_THAT(claimed, HasSubstr(fmt::format("\"{}\"", name)));
}

}  // namespace
}  // namespace lucerna::bake
