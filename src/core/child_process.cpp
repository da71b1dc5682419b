#include "core/child_process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <utility>

#include "core/progress.hpp"

namespace lucerna {
namespace {

using Clock = std::chrono::steady_clock;
constexpr int kWatchIntervalMs = 20;
constexpr std::size_t kKeptErrorBytes = 64 << 10;

// Both ends closed with the object, or earlier by hand.
struct Pipe {
  int readEnd = -1, writeEnd = -1;

  Pipe() = default;
  ~Pipe() {
    closeEnd(readEnd);
    closeEnd(writeEnd);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  bool open() {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) return false;
    readEnd = ends[0];
    writeEnd = ends[1];
    return true;
  }
  static void closeEnd(int& end) {
    if (end >= 0) ::close(std::exchange(end, -1));
  }
};

// Writing to a child that has died must be an error code here, not a signal to the program.
class BlockedPipeSignal {
 public:
  BlockedPipeSignal() {
    sigset_t wanted;
    sigemptyset(&wanted);
    sigaddset(&wanted, SIGPIPE);
    pthread_sigmask(SIG_BLOCK, &wanted, &previous_);
  }
  ~BlockedPipeSignal() {
    sigset_t wanted;
    sigemptyset(&wanted);
    sigaddset(&wanted, SIGPIPE);
    const timespec now = {};
    if (!sigismember(&previous_, SIGPIPE))
      while (sigtimedwait(&wanted, nullptr, &now) > 0) {
      }
    pthread_sigmask(SIG_SETMASK, &previous_, nullptr);
  }
  BlockedPipeSignal(const BlockedPipeSignal&) = delete;
  BlockedPipeSignal& operator=(const BlockedPipeSignal&) = delete;

 private:
  sigset_t previous_;
};

struct Pipes {
  Pipe in, out, err, start;  // start: carries errno if exec fails, closes when it succeeds
  bool open() { return in.open() && out.open() && err.open() && start.open(); }
};

// Marks everything above stderr close-on-exec. Only calls that are safe between fork and exec.
void closeOtherFiles(int fileLimit) {
  if (close_range(3, ~0u, CLOSE_RANGE_CLOEXEC) == 0) return;
  for (int file = 3; file < fileLimit; ++file) fcntl(file, F_SETFD, FD_CLOEXEC);
}

// In the child, after fork: other threads are gone with whatever locks they held, so nothing here
// may allocate.
[[noreturn]] void becomeProgram(const char* program, char* const* arguments, const Pipes& pipes,
                                pid_t parent, int fileLimit) {
  setsid();
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(127);  // the parent died before the line above
  const rlimit none = {0, 0};
  setrlimit(RLIMIT_CORE, &none);
  signal(SIGPIPE, SIG_DFL);
  signal(SIGINT, SIG_DFL);
  sigset_t empty;
  sigemptyset(&empty);
  sigprocmask(SIG_SETMASK, &empty, nullptr);
  dup2(pipes.in.readEnd, STDIN_FILENO);
  dup2(pipes.out.writeEnd, STDOUT_FILENO);
  dup2(pipes.err.writeEnd, STDERR_FILENO);
  closeOtherFiles(fileLimit);
  execv(program, arguments);
  const int code = errno;
  [[maybe_unused]] const ssize_t written = ::write(pipes.start.writeEnd, &code, sizeof code);
  _exit(127);
}

std::uint64_t residentBytes(pid_t process) {
  std::array<char, 128> text{};
  std::snprintf(text.data(), text.size(), "/proc/%d/statm", process);
  const int file = ::open(text.data(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return 0;
  text.fill(0);
  const ssize_t count = ::read(file, text.data(), text.size() - 1);
  ::close(file);
  unsigned long long total = 0, resident = 0;
  if (count <= 0 || std::sscanf(text.data(), "%llu %llu", &total, &resident) != 2) return 0;
  static const auto pageBytes = static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
  return resident * pageBytes;
}

// Feeds and drains one running child until it ends or meets a limit.
class Watch {
 public:
  Watch(pid_t process, Pipes& pipes, std::span<const std::byte> input, const ChildLimits& limits,
        ChildOutput& output)
      : process_(process), pipes_(pipes), input_(input), limits_(limits), output_(output) {
    for (const int end : {pipes.in.writeEnd, pipes.out.readEnd, pipes.err.readEnd})
      fcntl(end, F_SETFL, fcntl(end, F_GETFL) | O_NONBLOCK);
    if (input_.empty()) Pipe::closeEnd(pipes_.in.writeEnd);
  }

  void run() {
    std::optional<ChildOutput::End> cut;
    while (!cut && !ended()) {
      waitForPipes();
      transfer();
      cut = limitMet();
    }
    // The leader is dead or about to be; until it is reaped below, its group's number is ours.
    kill(-process_, SIGKILL);
    int status = 0;
    while (waitpid(process_, &status, 0) < 0 && errno == EINTR) {
    }
    transfer();  // what was still in the pipes
    if (!cut && output_.out.size() > limits_.outputBytes) cut = ChildOutput::End::TooMuchOutput;
    record(status, cut);
  }

 private:
  bool ended() const {
    siginfo_t info = {};
    return waitid(P_PID, static_cast<id_t>(process_), &info, WEXITED | WNOHANG | WNOWAIT) == 0 &&
           info.si_pid == process_;
  }

  void waitForPipes() const {
    // poll ignores closed (negative) ends. With none left only the exit is awaited, which is near.
    std::array<pollfd, 3> ends = {{{pipes_.in.writeEnd, POLLOUT, 0},
                                   {pipes_.out.readEnd, POLLIN, 0},
                                   {pipes_.err.readEnd, POLLIN, 0}}};
    const bool outputClosed = pipes_.out.readEnd < 0 && pipes_.err.readEnd < 0;
    poll(ends.data(), ends.size(), outputClosed ? 1 : kWatchIntervalMs);
  }

  void transfer() {
    feed();
    drain(pipes_.out.readEnd, [&](std::span<const std::byte> part) {
      output_.out.insert(output_.out.end(), part.begin(), part.end());
    });
    drain(pipes_.err.readEnd, [&](std::span<const std::byte> part) {
      output_.err.append(reinterpret_cast<const char*>(part.data()), part.size());
      if (output_.err.size() > 2 * kKeptErrorBytes)
        output_.err.erase(0, output_.err.size() - kKeptErrorBytes);
    });
  }

  void feed() {
    while (pipes_.in.writeEnd >= 0) {
      const ssize_t count = ::write(pipes_.in.writeEnd, input_.data(), input_.size());
      if (count < 0 && errno == EINTR) continue;
      if (count < 0 && errno == EAGAIN) return;
      if (count > 0) input_ = input_.subspan(static_cast<std::size_t>(count));
      if (count < 0 || input_.empty()) Pipe::closeEnd(pipes_.in.writeEnd);
    }
  }

  // Reads what is there, at most a bounded amount so that the limits are looked at in between.
  template <typename Take>
  void drain(int& end, Take take) {
    std::array<std::byte, 64 << 10> buffer;
    for (int rounds = 0; end >= 0 && rounds < 64; ++rounds) {
      const ssize_t count = ::read(end, buffer.data(), buffer.size());
      if (count < 0 && errno == EINTR) continue;
      if (count < 0 && errno == EAGAIN) return;
      if (count <= 0) return Pipe::closeEnd(end);
      take(std::span<const std::byte>(buffer.data(), static_cast<std::size_t>(count)));
    }
  }

  std::optional<ChildOutput::End> limitMet() {
    const Clock::time_point now = Clock::now();
    if (output_.out.size() > limits_.outputBytes) return ChildOutput::End::TooMuchOutput;
    if (now - start_ > limits_.time) return ChildOutput::End::TimedOut;
    if (Progress::cancelled()) return ChildOutput::End::Cancelled;
    if (now - memoryChecked_ < std::chrono::milliseconds(kWatchIntervalMs)) return {};
    memoryChecked_ = now;
    if (residentBytes(process_) > limits_.residentBytes) return ChildOutput::End::OutOfMemory;
    return {};
  }

  void record(int status, std::optional<ChildOutput::End> cut) {
    output_.end = WIFSIGNALED(status) ? ChildOutput::End::Signalled : ChildOutput::End::Exited;
    output_.status = WIFSIGNALED(status) ? WTERMSIG(status) : WEXITSTATUS(status);
    if (cut) output_.end = *cut;
    if (output_.err.size() > kKeptErrorBytes)
      output_.err.erase(0, output_.err.size() - kKeptErrorBytes);
  }

  pid_t process_;
  Pipes& pipes_;
  std::span<const std::byte> input_;
  const ChildLimits& limits_;
  ChildOutput& output_;
  Clock::time_point start_ = Clock::now();
  Clock::time_point memoryChecked_{};
};

ChildOutput notStarted(const std::string& program, int code) {
  ChildOutput output;
  output.end = ChildOutput::End::NotStarted;
  output.status = code;
  output.err = program + ": " + std::strerror(code);
  return output;
}

std::string seconds(std::chrono::milliseconds time) {
  return fmt::format("{:g} s", std::chrono::duration<double>(time).count());
}

std::string mebibytes(std::uint64_t bytes) {
  return fmt::format("{} MiB", bytes >> 20);
}

}  // namespace

ChildOutput runChild(const std::filesystem::path& program,
                     const std::vector<std::string>& arguments, std::span<const std::byte> input,
                     const ChildLimits& limits) {
  const std::string path = program.string();
  std::vector<char*> argumentPointers{const_cast<char*>(path.c_str())};
  for (const std::string& argument : arguments)
    argumentPointers.push_back(const_cast<char*>(argument.c_str()));
  argumentPointers.push_back(nullptr);

  const BlockedPipeSignal blocked;
  Pipes pipes;
  if (!pipes.open()) return notStarted(path, errno);
  const pid_t parent = getpid();
  const auto fileLimit = static_cast<int>(std::min(sysconf(_SC_OPEN_MAX), 65536l));
  const pid_t process = fork();
  if (process < 0) return notStarted(path, errno);
  if (process == 0) becomeProgram(path.c_str(), argumentPointers.data(), pipes, parent, fileLimit);
  Pipe::closeEnd(pipes.in.readEnd);
  Pipe::closeEnd(pipes.out.writeEnd);
  Pipe::closeEnd(pipes.err.writeEnd);
  Pipe::closeEnd(pipes.start.writeEnd);

  int code = 0;
  ssize_t count = 0;
  while ((count = ::read(pipes.start.readEnd, &code, sizeof code)) < 0 && errno == EINTR) {
  }
  if (count == sizeof code) {
    waitpid(process, nullptr, 0);
    return notStarted(path, code);
  }
  ChildOutput output;
  Watch(process, pipes, input, limits, output).run();
  return output;
}

std::string describeEnd(const ChildOutput& output, const ChildLimits& limits) {
  switch (output.end) {
    case ChildOutput::End::Exited:
      return fmt::format("ended with code {}", output.status);
    case ChildOutput::End::Signalled:
      return fmt::format("crashed (signal {})", output.status);
    case ChildOutput::End::TimedOut:
      return fmt::format("was killed after {}", seconds(limits.time));
    case ChildOutput::End::OutOfMemory:
      return fmt::format("was killed because it used more than {} of memory",
                         mebibytes(limits.residentBytes));
    case ChildOutput::End::TooMuchOutput:
      return fmt::format("was killed because it wrote more than {}", mebibytes(limits.outputBytes));
    case ChildOutput::End::NotStarted:
      return "could not be started (" + output.err + ")";
    case ChildOutput::End::Cancelled:
      return "was cancelled";
  }
  return "";
}

}  // namespace lucerna
