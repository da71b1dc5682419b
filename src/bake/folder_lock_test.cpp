#include "bake/folder_lock.hpp"

#include <gmock/gmock.h>

#include <atomic>
#include <fstream>
#include <thread>

#include "core/test_folder.hpp"

namespace lucerna::bake {
namespace {

namespace fs = std::filesystem;
using Use = FolderLock::Use;

class FolderLockTest : public testing::Test {
 protected:
  Result<FolderLock> take(Use use) const { return FolderLock::take(folder_.path(), use); }
  void expectRefused(Use use) const {
    const auto second = take(use);
    ASSERT_FALSE(second);
    EXPECT_EQ(second.error().kind, ErrorKind::Failed);
    EXPECT_THAT(second.error().message,
                testing::HasSubstr("another process writes into it at the moment"));
  }

  TestFolder folder_;
  fs::path file_ = folder_ / "work/bake.lock";
};

TEST_F(FolderLockTest, ManyLightOneWrites) {
  {
    const auto first = take(Use::Light), second = take(Use::Light);
    EXPECT_TRUE(first);
    EXPECT_TRUE(second);
    expectRefused(Use::Write);
  }
  const auto writing = take(Use::Write);
  EXPECT_TRUE(writing);
  expectRefused(Use::Light);
  expectRefused(Use::Write);
  EXPECT_TRUE(fs::exists(file_));  // who was refused has removed nothing
}

TEST_F(FolderLockTest, AfterWritingNothingIsLeft) {
  EXPECT_TRUE(take(Use::Light));
  EXPECT_TRUE(fs::exists(file_));
  EXPECT_TRUE(take(Use::Write));
  EXPECT_TRUE(fs::is_empty(folder_.path()));
  EXPECT_TRUE(take(Use::Light));
  std::ofstream(folder_ / "work/bake.json") << "{}";
  EXPECT_TRUE(take(Use::Write));
  EXPECT_FALSE(fs::exists(file_));
  EXPECT_TRUE(fs::exists(folder_ / "work/bake.json"));
}

// Each ends by removing the file that the others wait for.
TEST_F(FolderLockTest, OfManyThatWriteEachIsAlone) {
  std::atomic<int> inside{0}, had{0}, together{0};
  const auto write = [&] {
    for (int i = 0; i < 20; ++i) {
      const auto lock = take(Use::Write);
      if (!lock) continue;
      ++had;
      if (++inside != 1) ++together;
      std::this_thread::yield();
      --inside;
    }
  };
  {
    const std::jthread a(write), b(write), c(write);
  }
  EXPECT_EQ(together, 0);
  EXPECT_GT(had, 0);
  EXPECT_TRUE(fs::is_empty(folder_.path()));
}

TEST_F(FolderLockTest, WhatCannotBeLockedIsNamed) {
  fs::create_directories(file_);
  const auto lock = take(Use::Light);
  ASSERT_FALSE(lock);
  EXPECT_THAT(lock.error().message, testing::AllOf(testing::HasSubstr(file_.string()),
                                                   testing::HasSubstr("cannot be locked")));
}

}  // namespace
}  // namespace lucerna::bake
