#include "core/file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <utility>

namespace lucerna {
namespace {

namespace fs = std::filesystem;

std::string reason(int code) {
  return std::strerror(code);
}

class Descriptor {
 public:
  explicit Descriptor(int value) : value_(value) {}
  ~Descriptor() {
    if (value_ >= 0) ::close(value_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const { return value_; }
  // Closes it now and reports whether the kernel took all data.
  bool close() { return ::close(std::exchange(value_, -1)) == 0; }

 private:
  int value_;
};

// Reads up to `size` bytes: fewer only when the file has become shorter meanwhile.
Result<std::size_t> readFully(int file, std::byte* to, std::size_t size, const fs::path& path) {
  std::size_t done = 0;
  while (done < size) {
    const ssize_t count = ::read(file, to + done, size - done);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0)
      return error(ErrorKind::Input, "{}: reading failed after {} bytes: {}", path.string(), done,
                   reason(errno));
    if (count == 0) break;
    done += static_cast<std::size_t>(count);
  }
  return done;
}

template <typename Container>
Result<Container> readWhole(const fs::path& path, std::uint64_t limit) {
  // O_NONBLOCK: opening a named pipe must not hang.
  Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (file.get() < 0)
    return error(ErrorKind::Input, "{}: cannot be opened: {}; check the path and its permissions",
                 path.string(), reason(errno));
  struct stat about = {};
  if (::fstat(file.get(), &about) != 0)
    return error(ErrorKind::Input, "{}: cannot be examined: {}", path.string(), reason(errno));
  if (!S_ISREG(about.st_mode))
    return error(ErrorKind::Input, "{}: is {}, a file was wanted", path.string(),
                 S_ISDIR(about.st_mode) ? "a folder" : "a device or pipe");
  const auto size = static_cast<std::uint64_t>(about.st_size);
  if (size > limit)
    return error(ErrorKind::Input, "{}: has {} bytes, at most {} are read here", path.string(),
                 size, limit);
  Container content;
  content.resize(size);
  LUCERNA_TRY(count,
              readFully(file.get(), reinterpret_cast<std::byte*>(content.data()), size, path));
  content.resize(count);
  return content;
}

Status writeFully(int file, std::span<const std::byte> bytes, const fs::path& path) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(file, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0)
      return error(ErrorKind::Failed, "{}: writing failed: {}; check the free space", path.string(),
                   reason(errno));
    bytes = bytes.subspan(static_cast<std::size_t>(count));
  }
  return {};
}

// Messages name the file as the caller gave it.
Status writeTo(const fs::path& path, const fs::path& asGiven, int flags,
               std::span<const std::byte> bytes) {
  Descriptor file(::open(path.c_str(), O_WRONLY | O_CLOEXEC | flags, 0666));
  if (file.get() < 0)
    return error(ErrorKind::Failed,
                 "{}: cannot be written: {}; check that the folder exists and is writable",
                 asGiven.string(), reason(errno));
  LUCERNA_TRY_VOID(writeFully(file.get(), bytes, asGiven));
  if (!file.close())
    return error(ErrorKind::Failed, "{}: writing failed: {}; check the free space",
                 asGiven.string(), reason(errno));
  return {};
}

// A name in the same folder that no other writer uses; it keeps the extension and is hidden.
fs::path temporaryBeside(const fs::path& path) {
  static std::atomic<unsigned> counter{0};
  const std::string name = fmt::format(".{}.tmp-{}-{}{}", path.stem().string(), ::getpid(),
                                       counter++, path.extension().string());
  return path.parent_path() / name;
}

// Where to write so that links stay links; the path itself if it is none.
fs::path throughLinks(const fs::path& path) {
  std::error_code code;
  if (!fs::is_symlink(path, code)) return path;
  const fs::path target = fs::weakly_canonical(path, code);
  return code ? path : target;
}

Status checkTarget(const fs::path& target, const fs::path& asGiven) {
  std::error_code code;
  const fs::path folder = target.parent_path();
  if (!folder.empty() && !fs::is_directory(folder, code))
    return error(ErrorKind::Failed, "{}: the folder {} does not exist; create it first",
                 asGiven.string(), folder.string());
  if (target.filename().empty() || fs::is_directory(target, code))
    return error(ErrorKind::Failed, "{}: is a folder, a file name was wanted", asGiven.string());
  return {};
}

// Devices and pipes (/dev/stdout) take bytes but must never be renamed over.
bool isDeviceOrPipe(const fs::path& path) {
  std::error_code code;
  return fs::exists(path, code) && fs::is_other(path, code);
}

}  // namespace

Status checkFolderOf(const fs::path& path, std::string_view option) {
  const fs::path folder = path.parent_path();
  std::error_code noFolder;
  if (!folder.empty() && !fs::is_directory(folder, noFolder))
    return error(ErrorKind::Usage, "{}: the folder '{}' does not exist; make it first", option,
                 folder.string());
  if (fs::is_directory(path, noFolder))
    return error(ErrorKind::Usage, "{}: '{}' is a folder; name a file in it", option,
                 path.string());
  return {};
}

Status checkIsNone(const fs::path& path, std::string_view option,
                   std::span<const std::string> files) {
  for (const std::string& file : files) {
    std::error_code missing;
    if (!file.empty() && (fs::equivalent(path, file, missing) || path == file))
      return error(ErrorKind::Usage,
                   "{}: '{}' is also read or written otherwise; name another file", option,
                   path.string());
  }
  return {};
}

Result<Bytes> readFile(const fs::path& path, std::uint64_t limit) {
  return readWhole<Bytes>(path, limit);
}

Result<std::string> readText(const fs::path& path, std::uint64_t limit) {
  return readWhole<std::string>(path, limit);
}

Status writeFile(const fs::path& path, std::span<const std::byte> bytes) {
  if (isDeviceOrPipe(path)) return writeTo(path, path, 0, bytes);
  LUCERNA_TRY(file, AtomicFile::create(path));
  LUCERNA_TRY_VOID(writeTo(file.temporary(), path, O_CREAT | O_EXCL, bytes));
  return file.commit();
}

Status writeText(const fs::path& path, std::string_view text) {
  return writeFile(path, std::as_bytes(std::span(text.data(), text.size())));
}

Result<AtomicFile> AtomicFile::create(const fs::path& path) {
  if (isDeviceOrPipe(path))
    return error(ErrorKind::Failed, "{}: is a device or pipe, a file name was wanted",
                 path.string());
  const fs::path target = throughLinks(path);
  LUCERNA_TRY_VOID(checkTarget(target, path));
  return AtomicFile(path, target);
}

AtomicFile::AtomicFile(fs::path path, fs::path target)
    : path_(std::move(path)), target_(std::move(target)), temporary_(temporaryBeside(target_)) {}

AtomicFile::AtomicFile(AtomicFile&& other) noexcept
    : path_(std::move(other.path_)),
      target_(std::move(other.target_)),
      temporary_(std::exchange(other.temporary_, {})) {}

AtomicFile::~AtomicFile() {
  std::error_code ignored;
  if (!temporary_.empty()) fs::remove(temporary_, ignored);
}

Status AtomicFile::commit() {
  std::error_code code;
  fs::rename(temporary_, target_, code);
  if (code)
    return error(ErrorKind::Failed, "{}: cannot be replaced: {}", path_.string(), code.message());
  temporary_.clear();
  return {};
}

}  // namespace lucerna
