#include "core/parallel.hpp"

#include <gmock/gmock.h>

#include <atomic>
#include <set>
#include <thread>
#include <vector>

namespace lucerna {
namespace {

class ParallelTest : public testing::TestWithParam<int> {
 protected:
  ParallelTest() { setThreadCount(GetParam()); }
  ~ParallelTest() override { setThreadCount(0); }
};

TEST_P(ParallelTest, CoversEachIndexOnce) {
  EXPECT_EQ(threadCount(), GetParam());
  for (const std::size_t count : {0, 1, 7, 64, 1000, 4097})
    for (const std::size_t grain : {1, 3, 64, 5000}) {
      std::vector<std::atomic<int>> visits(count);
      parallelFor(count, grain, [&](std::size_t begin, std::size_t end) {
        EXPECT_LT(begin, end);
        EXPECT_LE(end - begin, grain);
        EXPECT_EQ(begin % grain, 0u);
        for (std::size_t i = begin; i < end; ++i) ++visits[i];
      });
      for (const auto& visit : visits) ASSERT_EQ(visit, 1) << count << ' ' << grain;
    }
}

TEST_P(ParallelTest, AnExceptionReachesTheCallerAndThePoolGoesOn) {
  for (int round = 0; round < 20; ++round)
    EXPECT_THROW(parallelFor(1000, 1,
                             [&](std::size_t begin, std::size_t) {
                               if (begin % 100 == 37) throw std::bad_alloc();
                             }),
                 std::bad_alloc);
  std::atomic<int> visits{0};
  parallelFor(1000, 1, [&](std::size_t, std::size_t) { ++visits; });
  EXPECT_EQ(visits, 1000);
}

TEST_P(ParallelTest, ALoopInsideALoopRunsOnTheSameThread) {
  std::atomic<int> sum{0};
  parallelFor(8, 1, [&](std::size_t, std::size_t) {
    const auto outer = std::this_thread::get_id();
    parallelFor(10, 2, [&](std::size_t begin, std::size_t end) {
      EXPECT_EQ(std::this_thread::get_id(), outer);
      sum += static_cast<int>(end - begin);
    });
  });
  EXPECT_EQ(sum, 80);
}

TEST_P(ParallelTest, LoopsFromSeveralThreadsDoNotMix) {
  std::vector<std::thread> callers;
  std::atomic<int> wrong{0};
  for (int caller = 0; caller < 4; ++caller)
    callers.emplace_back([&] {
      for (int round = 0; round < 50; ++round) {
        std::atomic<std::size_t> sum{0};
        parallelFor(100, 3, [&](std::size_t begin, std::size_t end) {
          for (std::size_t i = begin; i < end; ++i) sum += i;
        });
        if (sum != 4950) ++wrong;
      }
    });
  for (auto& caller : callers) caller.join();
  EXPECT_EQ(wrong, 0);
}

INSTANTIATE_TEST_SUITE_P(Threads, ParallelTest, testing::Values(1, 2, 3, 8));

TEST(Parallel, SeveralThreadsReallyWork) {
  setThreadCount(2);
  // Each of the two blocks waits for the other to begin, which one thread alone could not do.
  std::atomic<int> begun{0};
  parallelFor(2, 1, [&](std::size_t, std::size_t) {
    ++begun;
    for (int i = 0; i < 10'000 && begun < 2; ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
  });
  EXPECT_EQ(begun, 2);
  setThreadCount(0);
}

}  // namespace
}  // namespace lucerna
