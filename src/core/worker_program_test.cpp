#include "core/worker_program.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

namespace lucerna {
namespace {

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

}  // namespace
}  // namespace lucerna
