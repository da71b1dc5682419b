#include "bake/folder_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <thread>
#include <utility>

#include "bake/seconds.hpp"
#include "bake/shards.hpp"

namespace lucerna::bake {
namespace {

namespace fs = std::filesystem;

// Some have it only to look whether anything is to be done.
constexpr double kPatience = 1.;  // s
constexpr auto kPause = std::chrono::milliseconds(10);

// Not if who had it has removed it since it was opened.
bool isStillThere(int file, const fs::path& path) {
  struct stat opened{}, there{};
  return fstat(file, &opened) == 0 && stat(path.c_str(), &there) == 0 &&
         opened.st_dev == there.st_dev && opened.st_ino == there.st_ino;
}

// 0, or what stands in the way (errno); EWOULDBLOCK: another process.
int tryLock(int file, const fs::path& path, FolderLock::Use use) {
  if (file < 0) return errno == ENOENT ? EWOULDBLOCK : errno;  // DIR/work was removed just now
  const int kind = use == FolderLock::Use::Write ? LOCK_EX : LOCK_SH;
  if (flock(file, kind | LOCK_NB) != 0) return errno;
  return isStillThere(file, path) ? 0 : EWOULDBLOCK;
}

Error refused(const fs::path& folder, const fs::path& path, int fault) {
  if (fault == EWOULDBLOCK)
    return error(ErrorKind::Failed,
                 "'{}': another process writes into it at the moment; wait for it, or choose "
                 "another folder",
                 folder.string());
  return error(ErrorKind::Failed,
               "{}: cannot be locked ({}); wanted a folder that can be written, on a file system "
               "that has locks",
               path.string(), std::strerror(fault));
}

}  // namespace

FolderLock::FolderLock(fs::path path, int file, Use use)
    : path_(std::move(path)), file_(file), use_(use) {}

FolderLock::FolderLock(FolderLock&& other) noexcept
    : path_(std::move(other.path_)), file_(std::exchange(other.file_, -1)), use_(other.use_) {}

FolderLock::~FolderLock() {
  if (file_ < 0) return;
  std::error_code ignored;
  if (use_ == Use::Write) {
    fs::remove(path_, ignored);
    fs::remove(path_.parent_path(), ignored);  // only if it is empty
  }
  close(file_);
}

Result<FolderLock> FolderLock::take(const fs::path& folder, Use use) {
  const fs::path path = folder / kWorkFolder / kLockFile;
  for (const auto start = Clock::now();; std::this_thread::sleep_for(kPause)) {
    std::error_code ignored;
    fs::create_directory(path.parent_path(), ignored);
    const int file = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    const int fault = tryLock(file, path, use);
    if (fault == 0) return FolderLock(path, file, use);
    if (file >= 0) close(file);
    if (fault != EWOULDBLOCK || secondsSince(start) > kPatience)
      return refused(folder, path, fault);
  }
}

}  // namespace lucerna::bake
