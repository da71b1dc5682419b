#include "core/file.hpp"

#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>

#include "core/test_folder.hpp"

namespace lucerna {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class FileTest : public testing::Test {
 protected:
  int entries() const {
    return static_cast<int>(std::distance(fs::directory_iterator(folder_), {}));
  }

  TestFolder own_;
  fs::path folder_ = own_.path();
};

TEST_F(FileTest, WritesAndReadsTheSameBytes) {
  std::string text = "two\nlines";
  text += '\0';
  ASSERT_TRUE(writeText(folder_ / "a.txt", text));
  EXPECT_EQ(*readText(folder_ / "a.txt"), text);
  EXPECT_EQ(readFile(folder_ / "a.txt")->size(), text.size());
  ASSERT_TRUE(writeText(folder_ / "a.txt", ""));
  EXPECT_EQ(*readText(folder_ / "a.txt"), "");
  EXPECT_EQ(entries(), 1);
}

TEST_F(FileTest, RefusesWhatIsNoFileOrTooLarge) {
  EXPECT_THAT(readFile(folder_ / "absent").error().message, HasSubstr("absent: cannot be opened"));
  EXPECT_EQ(readFile(folder_ / "absent").error().kind, ErrorKind::Input);
  EXPECT_THAT(readFile(folder_).error().message, HasSubstr("is a folder"));
  ASSERT_EQ(::mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  EXPECT_THAT(readFile(folder_ / "pipe").error().message, HasSubstr("device or pipe"));
  ASSERT_TRUE(writeText(folder_ / "big", "12345"));
  EXPECT_TRUE(readFile(folder_ / "big", 5));
  EXPECT_THAT(readFile(folder_ / "big", 4).error().message, HasSubstr("has 5 bytes, at most 4"));
}

TEST_F(FileTest, AFailedWriterLeavesTheOldFileAndNothingElse) {
  ASSERT_TRUE(writeText(folder_ / "a.txt", "old"));
  {
    auto file = AtomicFile::create(folder_ / "a.txt");
    ASSERT_TRUE(file);
    EXPECT_EQ(file->temporary().extension(), ".txt");
    std::ofstream(file->temporary()) << "half of the new";
  }
  EXPECT_EQ(*readText(folder_ / "a.txt"), "old");
  EXPECT_EQ(entries(), 1);
}

TEST_F(FileTest, ASuccessfulWriterReplacesTheOldFile) {
  ASSERT_TRUE(writeText(folder_ / "a.txt", "old"));
  auto file = AtomicFile::create(folder_ / "a.txt");
  ASSERT_TRUE(file);
  ASSERT_TRUE(writeText(file->temporary(), "new"));
  EXPECT_EQ(*readText(folder_ / "a.txt"), "old") << "the target is untouched until the end";
  ASSERT_TRUE(file->commit());
  EXPECT_EQ(*readText(folder_ / "a.txt"), "new");
  EXPECT_EQ(entries(), 1);
}

TEST_F(FileTest, ImpossibleTargetsAreNamed) {
  EXPECT_THAT(writeText(folder_ / "no" / "a.txt", "x").error().message,
              HasSubstr("does not exist; create it first"));
  EXPECT_THAT(writeText(folder_, "x").error().message, HasSubstr("is a folder"));
  EXPECT_EQ(entries(), 0);
}

TEST_F(FileTest, DevicesAreNeverRenamedOver) {
  EXPECT_TRUE(writeText("/dev/null", "x"));
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  EXPECT_FALSE(AtomicFile::create("/dev/null"));
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST_F(FileTest, LinksStayLinks) {
  ASSERT_TRUE(writeText(folder_ / "target.txt", "old"));
  fs::create_symlink("target.txt", folder_ / "link.txt");
  ASSERT_TRUE(writeText(folder_ / "link.txt", "new"));
  EXPECT_TRUE(fs::is_symlink(folder_ / "link.txt"));
  EXPECT_EQ(*readText(folder_ / "target.txt"), "new");
}

}  // namespace
}  // namespace lucerna
