// Whole files in and out. Writing is atomic: a temporary file beside the target, then a rename, so
// a failure or a kill leaves no half-written output.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
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
// if its folder does not exist.
Status checkFolderOf(const std::filesystem::path& path, std::string_view option);

Status writeFile(const std::filesystem::path& path, std::span<const std::byte> bytes);
Status writeText(const std::filesystem::path& path, std::string_view text);

// For writers that want a path (OpenEXR, libav): calls `write` with a temporary path in the folder
// of `path` (same extension) and renames it when `write` succeeded, removes it otherwise.
Status writeAtomically(const std::filesystem::path& path,
                       const std::function<Status(const std::filesystem::path&)>& write);

}  // namespace lucerna
