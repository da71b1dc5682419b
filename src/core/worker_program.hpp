// The program that does untrusted work in a child process (core/child_process.hpp).
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/child_process.hpp"
#include "core/result.hpp"

namespace lucerna {

// What the environment variable LUCERNA_WORKER names, else lucerna_worker at its place relative to
// the file that holds this code: liblucerna, or a program that was linked with its parts. The place
// is the same in a build tree and in an installation, wherever that was moved to. The file may be
// missing.
std::filesystem::path workerProgram();

// Work for that program, and how to tell that it failed.
struct WorkerTask {
  std::vector<std::string> arguments = {};  // what it is to do: "import", "car.obj"
  std::span<const std::byte> input = {};    // for its stdin
  ChildLimits limits = {};
  std::string name = {};  // "car.obj: the reader of this file", where the sentence begins
  ErrorKind kind = ErrorKind::Input;  // of a failure that the data may have caused
  std::string remedy = {};            // for that
  std::string remedyAtLimit = {};     // for its going beyond `limits`; empty: the same
};

struct WorkerAnswer {
  // Good if it ended well. Else of the task's kind; or Cancelled; or Failed, where it could not be
  // started, for which the data are not to blame.
  Status status;
  Bytes out;        // what it wrote to stdout
  std::string err;  // and to stderr
};

// Runs the worker. One that refuses its data says why on stderr and ends with ErrorKind::Input as
// its code: these words are then the error.
WorkerAnswer runWorker(const WorkerTask& task);

}  // namespace lucerna
