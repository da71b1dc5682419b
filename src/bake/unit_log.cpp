#include "bake/unit_log.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <memory>

#include "core/check.hpp"
#include "core/hash.hpp"

namespace lucerna::bake {
namespace {

constexpr std::uint64_t kMagic = 0x31'67'6f'4c'65'6b'61'42ull;  // "BakeLog1"
constexpr std::uint64_t kMostPayload = 1ull << 30;

struct Header {
  std::uint64_t magic = kMagic, planHash = 0, units = 0, hash = 0;
  std::uint64_t own() const { return hashCombine(hashCombine(magic, planHash), units); }
};

struct Record {
  std::uint32_t unit = 0, spare = 0;  // spare: always 0
  std::uint64_t bytes = 0, payloadHash = 0, hash = 0;
  std::uint64_t own() const { return hashCombine(hashCombine(unit, bytes), payloadHash); }
};

std::string reason() {
  return std::strerror(errno);
}

// All of it, or an error that leaves errno.
bool writeAll(int file, std::uint64_t at, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t done = pwrite(file, bytes.data(), bytes.size(), static_cast<off_t>(at));
    if (done < 0 && errno == EINTR) continue;
    if (done <= 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(done));
    at += static_cast<std::uint64_t>(done);
  }
  return true;
}

bool readAll(int file, std::uint64_t at, std::span<std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t done = pread(file, bytes.data(), bytes.size(), static_cast<off_t>(at));
    if (done < 0 && errno == EINTR) continue;
    if (done <= 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(done));
    at += static_cast<std::uint64_t>(done);
  }
  return true;
}

template <typename T>
bool readOne(int file, std::uint64_t at, T& value) {
  return readAll(file, at, std::as_writable_bytes(std::span(&value, 1)));
}

struct Scan {
  LogState state;
  std::uint64_t end = 0;  // of the last record whose length can be trusted
};

// Goes through the records. A record whose payload is damaged is left out; from one whose own head
// is damaged on nothing can be found.
Result<Scan> scan(int file, const std::filesystem::path& path, std::uint64_t planHash,
                  std::size_t units,
                  const std::function<Status(std::uint32_t, std::span<const std::byte>)>& use) {
  struct stat status{};
  CHECK(fstat(file, &status) == 0);
  const auto size = static_cast<std::uint64_t>(status.st_size);
  Scan result;
  result.state.done.assign(units, false);
  Header header;
  if (size < sizeof header) return result;  // killed before it was written
  const auto damaged = [&](const char* what, std::uint64_t at) {
    result.state.damage.push_back(fmt::format("{}: {} at byte {}", path.string(), what, at));
  };
  if (!readOne(file, 0, header) || header.magic != kMagic || header.hash != header.own()) {
    damaged("found a damaged head", 0);
    return result;
  }
  if (header.planHash != planHash || header.units != units)
    return error(
        ErrorKind::Input,
        "{}: is of another scene, other settings or another kind of processor; remove it to "
        "bake that part again",
        path.string());
  std::uint64_t at = sizeof header;
  Bytes payload;
  for (; at < size;) {
    Record record;
    if (size - at < sizeof record) break;  // torn
    if (!readOne(file, at, record) || record.hash != record.own() || record.spare != 0 ||
        record.unit >= units || record.bytes > kMostPayload) {
      damaged("found a damaged record", at);
      break;
    }
    if (record.bytes > size - at - sizeof record) break;  // torn
    payload.resize(record.bytes);
    const bool sound =
        readAll(file, at + sizeof record, payload) && hashBytes(payload) == record.payloadHash;
    if (!sound) {
      damaged("found a damaged record", at);
    } else if (!result.state.done[record.unit]) {
      result.state.done[record.unit] = true;
      if (use) LUCERNA_TRY_VOID(use(record.unit, payload));
    }
    at += sizeof record + record.bytes;
    result.end = at;
  }
  result.end = std::max<std::uint64_t>(result.end, sizeof header);
  return result;
}

}  // namespace

UnitLog::UnitLog(std::filesystem::path path, int file)
    : path_(std::move(path)), file_(file), mutex_(std::make_unique<std::mutex>()) {}

UnitLog::UnitLog(UnitLog&& other) noexcept
    : path_(std::move(other.path_)),
      file_(std::exchange(other.file_, -1)),
      size_(other.size_),
      state_(std::move(other.state_)),
      mutex_(std::move(other.mutex_)) {}

UnitLog::~UnitLog() {
  if (file_ >= 0) close(file_);
}

Result<UnitLog> UnitLog::open(const std::filesystem::path& path, std::uint64_t planHash,
                              std::size_t units) {
  const int file = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (file < 0)
    return error(ErrorKind::Failed, "{}: cannot be written ({})", path.string(), reason());
  UnitLog log(path, file);
  if (flock(file, LOCK_EX | LOCK_NB) != 0) {
    if (errno != EWOULDBLOCK)
      return error(ErrorKind::Failed,
                   "{}: cannot be locked ({}); wanted a folder on a file system that has locks",
                   path.string(), reason());
    return error(
        ErrorKind::Failed,
        "{}: another process bakes this part at the moment; wait for it, or choose another "
        "folder",
        path.string());
  }
  LUCERNA_TRY(found, scan(file, path, planHash, units, {}));
  log.state_ = std::move(found.state);
  log.size_ = found.end;
  if (log.size_ == 0) {
    Header header{.planHash = planHash, .units = units};
    header.hash = header.own();
    if (!writeAll(file, 0, std::as_bytes(std::span(&header, 1))))
      return error(ErrorKind::Failed, "{}: cannot be written ({})", path.string(), reason());
    log.size_ = sizeof header;
  }
  if (ftruncate(file, static_cast<off_t>(log.size_)) != 0)
    return error(ErrorKind::Failed, "{}: cannot be cut ({})", path.string(), reason());
  return log;
}

Status UnitLog::append(std::uint32_t unit, std::span<const std::byte> payload) {
  Record record{.unit = unit, .bytes = payload.size(), .payloadHash = hashBytes(payload)};
  record.hash = record.own();
  Bytes bytes;
  bytes.reserve(sizeof record + payload.size());
  const auto head = std::as_bytes(std::span(&record, 1));
  bytes.insert(bytes.end(), head.begin(), head.end());
  bytes.insert(bytes.end(), payload.begin(), payload.end());
  const std::scoped_lock lock(*mutex_);
  if (!writeAll(file_, size_, bytes)) {
    const std::string why = reason();
    if (ftruncate(file_, static_cast<off_t>(size_)) != 0) {
      // The torn tail is dropped when the log is opened again.
    }
    return error(ErrorKind::Failed,
                 "{}: cannot be written ({}); what was finished is kept, go on with --resume",
                 path_.string(), why);
  }
  size_ += bytes.size();
  state_.done[unit] = true;
  return {};
}

Result<LogState> readUnitLog(
    const std::filesystem::path& path, std::uint64_t planHash, std::size_t units,
    const std::function<Status(std::uint32_t, std::span<const std::byte>)>& use) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return error(ErrorKind::Input, "{}: cannot be read ({})", path.string(), reason());
  auto found = scan(file, path, planHash, units, use);
  close(file);
  if (!found) return found.error();
  return std::move(found->state);
}

}  // namespace lucerna::bake
