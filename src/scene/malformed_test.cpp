// Every file of ../shared/scenes/malformed does what tests/malformed/manifest.json says: it is
// refused with a message, or drawn with a warning. Never a crash, a hang or a hunger for memory.
#include <gmock/gmock.h>
#include <sys/resource.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "core/test_folder.hpp"
#include "image/image_file.hpp"
#include "scene/load.hpp"

namespace lucerna::scene {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const fs::path kFolder = fs::path(LUCERNA_SOURCE_DIR) / "../shared/scenes/malformed";

const json& manifest() {
  static const json entries =
      json::parse(std::ifstream(fs::path(LUCERNA_SOURCE_DIR) / "tests/malformed/manifest.json"));
  return entries;
}

bool isSceneOrPicture(const fs::path& path) {
  static const std::set<std::string> kExtensions{".gltf", ".glb", ".obj", ".png"};
  return kExtensions.contains(path.extension().string());
}

// What reading a file led to: the words that the user gets.
struct Outcome {
  bool drawn = false;
  std::string words;
};

Outcome readFileOf(const fs::path& path) {
  if (path.extension() == ".png") {
    const auto image = readImage(path);
    return image ? Outcome{true, ""} : Outcome{false, image.error().message};
  }
  const auto scene = loadScene(path.string());
  if (!scene) {
    EXPECT_EQ(scene.error().kind, ErrorKind::Input);
    return {false, scene.error().message};
  }
  Outcome outcome{true, ""};
  for (const std::string& warning : scene->warnings) outcome.words += warning + "\n";
  return outcome;
}

// A copy of the file in the folder, with what it lacks beside it.
fs::path withSupplies(const fs::path& folder, const fs::path& file, const json& supplies) {
  fs::copy_file(file, folder / file.filename());
  for (const json& supply : supplies) {
    std::ofstream(folder / supply.at("name").get<std::string>(), std::ios::binary) << std::string(
        supply.at("bytes").get<std::size_t>(), static_cast<char>(supply.at("fill").get<int>()));
  }
  return folder / file.filename();
}

class Malformed : public testing::TestWithParam<std::size_t> {};

TEST_P(Malformed, DoesWhatTheManifestSays) {
  if (!fs::exists(kFolder)) GTEST_SKIP() << "no ../shared/scenes beside this checkout";
  const json& entry = manifest().at(GetParam());
  const TestFolder folder;
  fs::path file = kFolder / entry.at("file").get<std::string>();
  if (entry.contains("supply")) file = withSupplies(folder.path(), file, entry.at("supply"));
  SCOPED_TRACE(entry.dump());

  const auto start = std::chrono::steady_clock::now();
  const Outcome outcome = readFileOf(file);
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;

  EXPECT_EQ(outcome.drawn ? "drawn" : "refused", entry.at("outcome").get<std::string>())
      << outcome.words;
  EXPECT_THAT(outcome.words, testing::HasSubstr(entry.at("message").get<std::string>()));
  if (entry.at("message").get<std::string>().empty()) {
    EXPECT_EQ(outcome.words, "") << "no warning is wanted";
  }
  if (!outcome.drawn) {
    EXPECT_THAT(outcome.words, testing::HasSubstr(file.filename().string()));
  }
  EXPECT_LT(time.count(), 10.0);
}

INSTANTIATE_TEST_SUITE_P(Manifest, Malformed, testing::Range<std::size_t>(0, manifest().size()));

TEST(MalformedManifest, HasEveryFileOfTheFolder) {
  if (!fs::exists(kFolder)) GTEST_SKIP() << "no ../shared/scenes beside this checkout";
  std::set<std::string> known;
  for (const json& entry : manifest()) known.insert(entry.at("file").get<std::string>());
  std::set<std::string> unknown;
  for (const auto& entry : fs::recursive_directory_iterator(kFolder)) {
    if (!isSceneOrPicture(entry.path())) continue;
    const std::string name = entry.path().lexically_relative(kFolder).string();
    if (known.erase(name) == 0) unknown.insert(name);
  }
  EXPECT_THAT(unknown, testing::IsEmpty()) << "files without an entry";
  EXPECT_THAT(known, testing::IsEmpty()) << "entries without a file";
}

TEST(MalformedManifest, TakesLessThanAGibibyte) {
  if (!fs::exists(kFolder)) GTEST_SKIP() << "no ../shared/scenes beside this checkout";
  for (const json& entry : manifest()) readFileOf(kFolder / entry.at("file").get<std::string>());
  for (const int who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
    rusage usage{};
    getrusage(who, &usage);
    EXPECT_LT(usage.ru_maxrss, 1 << 20) << "KiB";
  }
}

}  // namespace
}  // namespace lucerna::scene
