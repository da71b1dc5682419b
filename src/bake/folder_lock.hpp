// Who bakes into DIR at the moment: a lock on DIR/work/bake.lock, which goes with its process.
//
// Shards that light share it; who writes or removes anything but logs has it alone. It is on a file
// since network file systems lock no folders from machine to machine.
#pragma once

#include <filesystem>

#include "core/result.hpp"

namespace lucerna::bake {

inline constexpr const char* kLockFile = "bake.lock";  // in DIR/work

class FolderLock {
 public:
  enum class Use { Light, Write };

  // DIR exists; makes DIR/work. ErrorKind::Failed: another process bakes there, still after a
  // second, or the file cannot be locked.
  static Result<FolderLock> take(const std::filesystem::path& folder, Use use);
  FolderLock(FolderLock&& other) noexcept;
  FolderLock& operator=(FolderLock&&) = delete;
  // After Use::Write removes the file, and DIR/work if nothing else is in it.
  ~FolderLock();

 private:
  FolderLock(std::filesystem::path path, int file, Use use);

  std::filesystem::path path_;
  int file_ = -1;
  Use use_;
};

}  // namespace lucerna::bake
