// Replays the corpus of every fuzz target: seeds, and what once failed.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "core/file.hpp"
#include "core/log.hpp"
#include "fuzz/fuzz.hpp"

namespace lucerna::fuzz {
namespace {

namespace fs = std::filesystem;

struct Target {
  std::string name;  // of its folder in corpus/
  void (*run)(ByteView bytes);
};
const Target kTargets[] = {{"gltf", gltf},
                           {"pipeline", pipeline},
                           {"scene_json", sceneJson},
                           {"image", image},
                           {"exr", exr},
                           {"script_answer", scriptAnswer},
                           {"import_answer", importAnswer},
                           {"draco_answer", dracoAnswer}};

const fs::path kCorpus = fs::path(LUCERNA_SOURCE_DIR) / "tests/fuzz/corpus";

struct Replay {
  Target target;
  fs::path file;
};

std::vector<fs::path> entries(const fs::path& folder) {
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator(folder)) found.push_back(entry.path());
  std::sort(found.begin(), found.end());
  return found;
}

std::vector<Replay> allReplays() {
  std::vector<Replay> replays;
  for (const Target& target : kTargets)
    for (const fs::path& file : entries(kCorpus / target.name)) replays.push_back({target, file});
  return replays;
}

// "gltf_deep_nesting_gltf"
std::string testName(const testing::TestParamInfo<Replay>& info) {
  std::string name = info.param.target.name + "_" + info.param.file.filename().string();
  std::replace_if(name.begin(), name.end(), [](unsigned char c) { return !std::isalnum(c); }, '_');
  return name;
}

class Corpus : public testing::TestWithParam<Replay> {};
INSTANTIATE_TEST_SUITE_P(All, Corpus, testing::ValuesIn(allReplays()), testName);

TEST_P(Corpus, DoesNoHarm) {
  log::setLevel(log::Level::Off);  // decoders warn
  const Bytes bytes = *readFile(GetParam().file);
  GetParam().target.run(bytes);
  log::setLevel(log::Level::Info);
}

// A folder that no target reads would be forgotten files; a target without one begins from nothing.
TEST(FuzzTargets, HaveAFolderEach) {
  std::vector<std::string> folders, targets;
  for (const fs::path& folder : entries(kCorpus)) {
    folders.push_back(folder.filename().string());
    EXPECT_FALSE(entries(folder).empty()) << folder;
  }
  for (const Target& target : kTargets) targets.push_back(target.name);
  std::sort(targets.begin(), targets.end());
  EXPECT_EQ(folders, targets);
}

}  // namespace
}  // namespace lucerna::fuzz
