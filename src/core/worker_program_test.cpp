#include "core/worker_program.hpp"

#include <gmock/gmock.h>
#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <thread>

#include "core/progress.hpp"
#include "core/test_folder.hpp"

namespace lucerna {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using namespace std::chrono_literals;

TEST(WorkerProgram, StandsBesideWhatIsRunningUnlessNamed) {
  unsetenv("LUCERNA_WORKER");
  const std::filesystem::path worker = workerProgram();
  EXPECT_EQ(worker.filename(), "lucerna_worker");
  const auto program = std::filesystem::read_symlink("/proc/self/exe");
  EXPECT_EQ(std::filesystem::weakly_canonical(program.parent_path() / LUCERNA_WORKER_FOLDER),
            worker.parent_path());
  setenv("LUCERNA_WORKER", "/opt/other", 1);
  EXPECT_EQ(workerProgram(), "/opt/other");
  unsetenv("LUCERNA_WORKER");
}

// A shell script stands in for the worker.
class RunWorker : public testing::Test {
 protected:
  ~RunWorker() override { unsetenv("LUCERNA_WORKER"); }
  WorkerAnswer answer(const std::string& script, WorkerTask task = {}) {
    const std::filesystem::path file = folder_ / "worker";
    std::ofstream(file) << "#!/bin/sh\n" << script << "\n";
    std::filesystem::permissions(file, std::filesystem::perms::owner_all);
    setenv("LUCERNA_WORKER", file.c_str(), 1);
    task.name = "a.obj: its reader";
    task.remedy = "export it again";
    return runWorker(task);
  }

  TestFolder folder_;
};

TEST_F(RunWorker, GivesWhatTheWorkerWrote) {
  const std::string input = "hello";
  const WorkerAnswer given =
      answer("cat; echo $1 $2 >&2",
             {.arguments = {"import", "b.obj"}, .input = std::as_bytes(std::span(input))});
  ASSERT_TRUE(given.status) << given.status.error().message;
  EXPECT_EQ(given.out.size(), 5u);
  EXPECT_EQ(given.err, "import b.obj\n");
}

TEST_F(RunWorker, TheDataAreToBlameForWhatTheyMayCause) {
  const Error crash = answer("kill -SEGV $$", {.kind = ErrorKind::Pipeline}).status.error();
  EXPECT_EQ(crash.kind, ErrorKind::Pipeline);
  EXPECT_EQ(crash.message, "a.obj: its reader crashed (signal 11); export it again");
  const ChildLimits limits{.time = 100ms};
  const Error late = answer("sleep 30", {.limits = limits, .remedyAtLimit = "less"}).status.error();
  EXPECT_EQ(late.kind, ErrorKind::Input);
  EXPECT_EQ(late.message, "a.obj: its reader was killed after 0.1 s; less");
  const Error refusal = answer("printf 'a.obj: has no triangles' >&2; exit 3").status.error();
  EXPECT_EQ(refusal.message, "a.obj: has no triangles");
}

TEST_F(RunWorker, TheDataAreNotToBlameForAnIncompleteInstallation) {
  const Error unloaded =
      answer("echo 'worker: libdraco.so.7 is missing' >&2; exit 127").status.error();
  EXPECT_EQ(unloaded.kind, ErrorKind::Failed);
  EXPECT_THAT(unloaded.message, AllOf(HasSubstr("could not be started (worker: libdraco.so.7"),
                                      HasSubstr("build or install it again")));
  setenv("LUCERNA_WORKER", "/nowhere/lucerna_worker", 1);
  const Error missing = runWorker({.name = "a.obj: its reader", .remedy = "no"}).status.error();
  EXPECT_EQ(missing.kind, ErrorKind::Failed);
  EXPECT_THAT(missing.message, AllOf(HasSubstr("/nowhere/lucerna_worker: No such file"),
                                     HasSubstr("build or install it again")));
}

TEST_F(RunWorker, CancellingIsNoFault) {
  // In a process of its own, since cancelling is for good; one that is started anew, since it makes
  // a thread.
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(
      {
        Progress::catchInterrupt();
        std::thread user([] {
          std::this_thread::sleep_for(100ms);
          kill(getpid(), SIGINT);
        });
        const WorkerAnswer given = answer("sleep 30");
        user.join();
        std::fprintf(stderr, "%s", given.status.error().message.c_str());
        std::_Exit(static_cast<int>(given.status.error().kind));
      },
      testing::ExitedWithCode(130), "a.obj: its reader was cancelled");
}

}  // namespace
}  // namespace lucerna
