// Work on untrusted input in a child process, so that a crash, a hang or an allocation without
// bounds becomes an error message.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/file.hpp"
#include "core/result.hpp"

namespace lucerna {

struct ChildLimits {
  std::chrono::milliseconds time{10'000};
  std::uint64_t residentBytes = 1ull << 30;
  std::uint64_t outputBytes = 4ull << 30;
};

struct ChildOutput {
  enum class End { Exited, Signalled, TimedOut, OutOfMemory, TooMuchOutput, NotStarted, Cancelled };
  End end = End::Exited;
  int status = 0;   // exit code or signal number
  Bytes out;        // what it wrote to stdout
  std::string err;  // what it wrote to stderr (the last 64 KiB)
};

// Runs `program arguments...` with `input` on its stdin; kills it at a limit (memory is watched
// from here: an address-space limit would abort garbage collectors). The child has its own session,
// no other open files and no core dump, and dies with its parent.
ChildOutput runChild(const std::filesystem::path& program,
                     const std::vector<std::string>& arguments, std::span<const std::byte> input,
                     const ChildLimits& limits);

// "was killed after 10 s", "crashed (signal 11)", ... for messages.
std::string describeEnd(const ChildOutput& output, const ChildLimits& limits);

}  // namespace lucerna
