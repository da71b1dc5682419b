// The log of finished units: a file that only grows, so that a bake that is killed loses no more
// than the unit under way. Each record has a hash; what does not match it is never used.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <mutex>
#include <string>
#include <vector>

#include "core/file.hpp"
#include "core/result.hpp"

namespace lucerna::bake {

// What opening or reading a log found.
struct LogState {
  std::vector<bool> done;           // by unit
  std::vector<std::string> damage;  // where the file is damaged; what stood there is not done
};

class UnitLog {
 public:
  // Opens or makes the log of a plan with that many units, and drops a torn tail, and all of a log
  // whose head is damaged. Errors: another process writes it (ErrorKind::Failed), it is of another
  // plan (ErrorKind::Input), it cannot be written (ErrorKind::Failed).
  static Result<UnitLog> open(const std::filesystem::path& path, std::uint64_t planHash,
                              std::size_t units);
  UnitLog(UnitLog&& other) noexcept;
  UnitLog& operator=(UnitLog&&) = delete;
  ~UnitLog();

  const LogState& state() const { return state_; }
  // Appends a record, whole or not at all; any thread.
  Status append(std::uint32_t unit, std::span<const std::byte> payload);

 private:
  UnitLog(std::filesystem::path path, int file);
  std::filesystem::path path_;
  int file_ = -1;
  std::uint64_t size_ = 0;  // bytes of whole records
  LogState state_;
  std::unique_ptr<std::mutex> mutex_;
};

// Calls use(unit, payload) for each sound record, the first of each unit, in the order of the file.
// What `use` returns ends the reading if it is an error.
Result<LogState> readUnitLog(
    const std::filesystem::path& path, std::uint64_t planHash, std::size_t units,
    const std::function<Status(std::uint32_t unit, std::span<const std::byte> payload)>& use);

}  // namespace lucerna::bake
