#include "core/child_process.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <signal.h>
#include <unistd.h>

#include <cstring>
#include <thread>

#include "core/progress.hpp"

namespace lucerna {
namespace {

using End = ChildOutput::End;
using testing::HasSubstr;
using namespace std::chrono_literals;

std::string text(const Bytes& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

ChildOutput shell(const std::string& script, const ChildLimits& limits = {},
                  std::string_view input = "") {
  return runChild("/bin/sh", {"-c", script}, std::as_bytes(std::span(input)), limits);
}

TEST(ChildProcess, PassesInputOutputErrorsAndCode) {
  const ChildOutput output = shell("cat; echo talk >&2; exit 3", {}, "hello");
  EXPECT_EQ(output.end, End::Exited);
  EXPECT_EQ(output.status, 3);
  EXPECT_EQ(text(output.out), "hello");
  EXPECT_EQ(output.err, "talk\n");
}

TEST(ChildProcess, CarriesMoreThanAPipeHoldsBothWays) {
  std::string input(3'000'000, 'a');
  for (std::size_t i = 0; i < input.size(); ++i) input[i] = static_cast<char>('a' + i % 23);
  EXPECT_EQ(text(shell("cat", {}, input).out), input);
}

TEST(ChildProcess, AChildThatIgnoresItsInputIsNoError) {
  const ChildOutput output = shell("exit 0", {}, std::string(1'000'000, 'x'));
  EXPECT_EQ(output.end, End::Exited);
  EXPECT_EQ(output.status, 0);
}

TEST(ChildProcess, KillsAtTheTimeLimitWithAllDescendants) {
  ChildLimits limits;
  limits.time = 200ms;
  const auto start = std::chrono::steady_clock::now();
  const ChildOutput output = shell("sleep 30 & echo $!; wait", limits);
  EXPECT_EQ(output.end, End::TimedOut);
  EXPECT_LT(std::chrono::steady_clock::now() - start, 5s);
  EXPECT_EQ(describeEnd(output, limits), "was killed after 0.2 s");
  // The grandchild is gone too (or a zombie that its new parent has yet to collect).
  const int grandchild = std::stoi(text(output.out));
  for (int i = 0; i < 200 && kill(grandchild, 0) == 0; ++i) std::this_thread::sleep_for(10ms);
  const auto state = readText("/proc/" + std::to_string(grandchild) + "/stat");
  EXPECT_TRUE(kill(grandchild, 0) != 0 || (state && state->find(") Z ") != std::string::npos));
}

TEST(ChildProcess, KillsAtTheMemoryLimit) {
  ChildLimits limits;
  limits.residentBytes = 64ull << 20;
  const ChildOutput output = shell("x=aaaaaaaaaaaaaaaa; while :; do x=$x$x; done", limits);
  EXPECT_EQ(output.end, End::OutOfMemory);
  EXPECT_EQ(describeEnd(output, limits), "was killed because it used more than 64 MiB of memory");
}

TEST(ChildProcess, KillsAtTheOutputLimit) {
  ChildLimits limits;
  limits.outputBytes = 1 << 20;
  const ChildOutput output = shell("while :; do echo 0123456789abcdef; done", limits);
  EXPECT_EQ(output.end, End::TooMuchOutput);
  EXPECT_LT(output.out.size(), 16u << 20);
}

TEST(ChildProcess, OutputJustBeforeTheExitCountsToo) {
  ChildLimits limits;
  limits.outputBytes = 4;
  EXPECT_EQ(shell("printf 12345", limits).end, End::TooMuchOutput);
  EXPECT_EQ(shell("printf 1234", limits).end, End::Exited);
}

TEST(ChildProcess, ReportsACrash) {
  const ChildOutput output = shell("kill -SEGV $$");
  EXPECT_EQ(output.end, End::Signalled);
  EXPECT_EQ(output.status, SIGSEGV);
  EXPECT_EQ(describeEnd(output, {}), "crashed (signal 11)");
}

TEST(ChildProcess, ReportsAProgramThatCannotStart) {
  const ChildOutput output = runChild("/no/such/program", {}, {}, {});
  EXPECT_EQ(output.end, End::NotStarted);
  EXPECT_EQ(output.status, ENOENT);
  EXPECT_THAT(describeEnd(output, {}), HasSubstr("/no/such/program: No such file"));
}

TEST(ChildProcess, KeepsTheEndOfLongErrors) {
  const ChildOutput output =
      shell("i=0; while [ $i -lt 20000 ]; do echo line $i >&2; i=$((i+1)); done");
  EXPECT_LE(output.err.size(), 64u << 10);
  EXPECT_THAT(output.err, testing::EndsWith("line 19999\n"));
}

TEST(ChildProcess, HasNoOtherFilesNoCoreAndItsOwnSession) {
  const int leaked = ::open("/dev/null", O_RDONLY);  // without close-on-exec
  ASSERT_GT(leaked, 2);
  // The shell's glob opens one file itself, so look at the number of ours.
  const std::string script = "[ -e /proc/$$/fd/" + std::to_string(leaked) +
                             " ] && echo leaked; ulimit -c; cut -d' ' -f6 /proc/$$/stat; echo $$";
  const std::string out = text(shell(script).out);
  ::close(leaked);
  EXPECT_THAT(out, testing::Not(HasSubstr("leaked")));
  int core = -1, session = -1, process = -2;
  ASSERT_EQ(std::sscanf(out.c_str(), "%d %d %d", &core, &session, &process), 3) << out;
  EXPECT_EQ(core, 0);
  EXPECT_EQ(session, process);
}

TEST(ChildProcess, EndsWhenTheUserCancels) {
  // In a process of its own, since cancelling is for good.
  EXPECT_EXIT(
      {
        Progress::catchInterrupt();
        std::thread user([] {
          std::this_thread::sleep_for(100ms);
          kill(getpid(), SIGINT);
        });
        const ChildOutput output = shell("sleep 30");
        user.join();
        std::fprintf(stderr, "%s", describeEnd(output, {}).c_str());
        std::exit(Progress::cancelled() && output.end == End::Cancelled ? 42 : 1);
      },
      testing::ExitedWithCode(42), "was cancelled");
}

TEST(ChildProcess, TheSecondInterruptKills) {
  EXPECT_EXIT(
      {
        Progress::catchInterrupt();
        raise(SIGINT);
        if (!Progress::cancelled()) std::exit(1);
        raise(SIGINT);
      },
      testing::KilledBySignal(SIGINT), "");
}

}  // namespace
}  // namespace lucerna
