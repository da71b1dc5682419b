// The program that does untrusted work in a child process (core/child_process.hpp).
#pragma once

#include <filesystem>

namespace lucerna {

// What the environment variable LUCERNA_WORKER names, else lucerna_worker at its place relative to
// the file that holds this code: liblucerna, or a program that was linked with its parts. The place
// is the same in a build tree and in an installation, wherever that was moved to. The file may be
// missing.
std::filesystem::path workerProgram();

}  // namespace lucerna
