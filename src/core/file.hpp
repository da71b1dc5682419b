// Whole files in and out. Writing is atomic: a temporary file beside the target, then a rename, so
// a failure or a kill leaves no half-written output.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.hpp"

namespace lucerna {

using Bytes = std::vector<std::byte>;

// Reads a regular file of at most `limit` bytes.
Result<Bytes> readFile(const std::filesystem::path& path, std::uint64_t limit = 4ull << 30);
Result<std::string> readText(const std::filesystem::path& path, std::uint64_t limit = 64ull << 20);

// Asks before long work: can a file stand there? ErrorKind::Usage, in the name of `option` ("-o"),
// if its folder does not exist or it is one itself.
Status checkFolderOf(const std::filesystem::path& path, std::string_view option);
// ErrorKind::Usage if `path`, to be written for `option`, is one of the files given, under whatever
// name; those that do not exist are none.
Status checkIsNone(const std::filesystem::path& path, std::string_view option,
                   std::span<const std::string> files);

Status writeFile(const std::filesystem::path& path, std::span<const std::byte> bytes);
Status writeText(const std::filesystem::path& path, std::string_view text);

// For writers that want a path (libav): a temporary file in the folder of `path`, with the same
// extension. commit() gives it its name; without that the destructor removes it.
class AtomicFile {
 public:
  // Errors (ErrorKind::Failed): no such folder; a folder, device or pipe of that name. Makes no
  // file.
  static Result<AtomicFile> create(const std::filesystem::path& path);
  AtomicFile(AtomicFile&& other) noexcept;
  AtomicFile& operator=(AtomicFile&&) = delete;
  ~AtomicFile();

  const std::filesystem::path& temporary() const { return temporary_; }
  Status commit();

 private:
  AtomicFile(std::filesystem::path path, std::filesystem::path target);

  std::filesystem::path path_, target_, temporary_;  // as given, through links, empty once moved
};

}  // namespace lucerna
