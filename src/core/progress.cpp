#include "core/progress.hpp"

#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <mutex>

namespace lucerna {
namespace {

using Clock = std::chrono::steady_clock;

constexpr auto kBarInterval = std::chrono::milliseconds(100);
constexpr auto kBarDelay = std::chrono::milliseconds(500);  // shorter work shows no bar
constexpr auto kLineInterval = std::chrono::seconds(5);
constexpr int kBarWidth = 30;

std::atomic<bool> interrupted{false};
std::atomic<bool> visible{true};
static_assert(std::atomic<bool>::is_always_lock_free, "the signal handler writes it");

void onInterrupt(int) {
  interrupted = true;
}

std::string minutesAndSeconds(double seconds) {
  const auto whole = static_cast<long long>(std::clamp(seconds, 0.0, 3.6e8) + 0.5);
  if (whole < 3600) return fmt::format("{}:{:02}", whole / 60, whole % 60);
  return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

}  // namespace

struct Progress::State {
  std::string label, counted;
  std::uint64_t total;
  bool terminal = isatty(STDERR_FILENO) == 1;
  Clock::time_point start = Clock::now();
  std::atomic<std::uint64_t> done{0}, counts{0};
  std::mutex mutex;  // guards what follows and the writing
  Clock::time_point nextShow;
  bool barShown = false;

  double elapsed() const { return std::chrono::duration<double>(Clock::now() - start).count(); }

  std::string remaining(double share) const {
    if (share <= 0) return "?";
    return minutesAndSeconds(elapsed() * (1 - share) / share);
  }

  // "  1.25 million rays/s"
  std::string rate() const {
    if (counted.empty()) return {};
    return fmt::format("  {:.3g} million {}/s",
                       static_cast<double>(counts) / 1e6 / std::max(elapsed(), 1e-3), counted);
  }

  void show() {
    const std::uint64_t now = std::min(done.load(), total);
    const double share = total == 0 ? 1 : static_cast<double>(now) / static_cast<double>(total);
    const std::string text =
        fmt::format("{:3} %  ETA {}{}", static_cast<int>(100 * share), remaining(share), rate());
    if (terminal) {
      const auto filled = static_cast<std::size_t>(share * kBarWidth);
      const std::string bar = std::string(filled, '=') + std::string(kBarWidth - filled, ' ');
      fmt::print(stderr, "\r\x1b[K{} [{}] {}", label, bar, text);
      barShown = true;
    } else {
      fmt::print(stderr, "{}: {}\n", label, text);
    }
    std::fflush(stderr);
  }
};

Progress::Progress(std::string label, std::uint64_t total, std::string counted)
    : state_(std::make_unique<State>()) {
  state_->label = std::move(label);
  state_->counted = std::move(counted);
  state_->total = total;
  state_->nextShow = state_->start + (state_->terminal ? Clock::duration(kBarDelay)
                                                       : Clock::duration(kLineInterval));
}

Progress::~Progress() {
  // The bar is only of use while the work runs.
  if (state_->barShown) std::fputs("\r\x1b[K", stderr);
}

void Progress::advance(std::uint64_t units, std::uint64_t counted) {
  state_->done += units;
  state_->counts += counted;
  if (!visible) return;
  // Whoever finds the lock taken leaves the showing to its holder.
  const std::unique_lock lock(state_->mutex, std::try_to_lock);
  if (!lock || Clock::now() < state_->nextShow) return;
  state_->show();
  state_->nextShow = Clock::now() + (state_->terminal ? Clock::duration(kBarInterval)
                                                      : Clock::duration(kLineInterval));
}

bool Progress::cancelled() {
  return interrupted;
}

void Progress::catchInterrupt() {
  struct sigaction action = {};
  action.sa_handler = onInterrupt;
  action.sa_flags = static_cast<int>(SA_RESETHAND);  // the second one has the default effect
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
}

void Progress::setVisible(bool shown) {
  visible = shown;
}

}  // namespace lucerna
