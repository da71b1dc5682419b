#include "core/parallel.hpp"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <deque>
#include <exception>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "core/check.hpp"

namespace lucerna {
namespace {

thread_local bool insideLoop = false;

struct Loop {
  std::size_t count, grain;
  const std::function<void(std::size_t, std::size_t)>& body;
  std::atomic<std::size_t> next{0};
  int helpers = 0;  // pool threads inside run(); guarded by the pool's mutex
  std::mutex failureMutex{};
  std::exception_ptr failure{};  // the first that a body threw

  // Takes blocks until none is left, or a body throws.
  void run() noexcept {
    insideLoop = true;
    for (;;) {
      const std::size_t begin = next.fetch_add(grain);
      if (begin >= count) break;
      try {
        body(begin, std::min(count, begin + grain));
      } catch (...) {
        next = count;
        const std::lock_guard lock(failureMutex);
        if (!failure) failure = std::current_exception();
      }
    }
    insideLoop = false;
  }
};

class Pool {
 public:
  explicit Pool(int threads) {
    for (int i = 1; i < threads; ++i) helpers_.emplace_back([this] { work(); });
  }
  ~Pool() {
    {
      const std::lock_guard lock(mutex_);
      stopping_ = true;
    }
    wake_.notify_all();
    for (std::thread& helper : helpers_) helper.join();
  }
  Pool(const Pool&) = delete;
  Pool& operator=(const Pool&) = delete;

  int threads() const { return static_cast<int>(helpers_.size()) + 1; }

  void run(Loop& loop) {
    {
      const std::lock_guard lock(mutex_);
      loops_.push_back(&loop);
    }
    wake_.notify_all();
    loop.run();
    std::unique_lock lock(mutex_);
    std::erase(loops_, &loop);  // from here on nobody joins it
    finished_.wait(lock, [&] { return loop.helpers == 0; });
  }

 private:
  void work() {
    std::unique_lock lock(mutex_);
    for (;;) {
      wake_.wait(lock, [&] { return stopping_ || !loops_.empty(); });
      if (stopping_) return;
      Loop& loop = *loops_.front();
      ++loop.helpers;
      lock.unlock();
      loop.run();
      lock.lock();
      std::erase(loops_, &loop);  // no blocks are left
      if (--loop.helpers == 0) finished_.notify_all();
    }
  }

  std::mutex mutex_;
  std::condition_variable wake_, finished_;
  std::deque<Loop*> loops_;
  bool stopping_ = false;
  std::vector<std::thread> helpers_;
};

std::mutex poolMutex;
std::shared_ptr<Pool> sharedPool;  // guarded by poolMutex; loops keep the pool that they began on

std::shared_ptr<Pool> makePool(int count) {
  const int cores = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  return std::make_shared<Pool>(count > 0 ? count : cores);
}

std::shared_ptr<Pool> pool() {
  const std::lock_guard lock(poolMutex);
  if (!sharedPool) sharedPool = makePool(0);
  return sharedPool;
}

}  // namespace

void setThreadCount(int count) {
  CHECK(count >= 0);
  CHECK(!insideLoop, "setThreadCount inside a parallel loop");
  std::shared_ptr<Pool> made = makePool(count);
  const std::lock_guard lock(poolMutex);
  sharedPool.swap(made);
}

int threadCount() {
  return pool()->threads();
}

void parallelFor(std::size_t count, std::size_t grain,
                 const std::function<void(std::size_t begin, std::size_t end)>& body) {
  CHECK(grain > 0);
  if (count == 0) return;
  if (insideLoop || count <= grain) {
    // The same blocks as in parallel, so that a body sees no difference.
    for (std::size_t begin = 0; begin < count; begin += grain)
      body(begin, std::min(count, begin + grain));
    return;
  }
  Loop loop{count, grain, body};
  pool()->run(loop);
  if (loop.failure) std::rethrow_exception(loop.failure);
}

}  // namespace lucerna
