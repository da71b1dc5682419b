#include "core/worker_program.hpp"

#include <dlfcn.h>
#include <link.h>

#include <cerrno>
#include <cstdlib>

#include "core/text.hpp"

namespace lucerna {
namespace {

// The file that this code was loaded from, or nothing.
std::filesystem::path ownFile() {
  Dl_info info;
  link_map* loaded = nullptr;
  const auto* here = reinterpret_cast<const void*>(&ownFile);
  const bool found = dladdr1(here, &info, reinterpret_cast<void**>(&loaded), RTLD_DL_LINKMAP) != 0;
  // The program itself has no name there, and its name as it was typed leads nowhere.
  const bool isLibrary = found && loaded && loaded->l_name && *loaded->l_name;
  std::error_code code;
  return std::filesystem::canonical(isLibrary ? loaded->l_name : "/proc/self/exe", code);
}

constexpr const char* kIncomplete = "a part of Lucerna is missing: build or install it again";
constexpr int kNotLoaded = 127;  // the code of a program whose libraries are missing

Status statusOf(const ChildOutput& child, const WorkerTask& task) {
  using End = ChildOutput::End;
  const auto failure = [&](ErrorKind kind, std::string_view remedy) {
    return error(kind, "{} {}; {}", task.name, describeEnd(child, task.limits), remedy);
  };
  switch (child.end) {
    case End::Cancelled:
      return error(ErrorKind::Cancelled, "{} was cancelled", task.name);
    case End::NotStarted:
      return failure(ErrorKind::Failed,
                     child.status == ENOENT
                         ? kIncomplete
                         : "may it be executed, and are memory and processes left?");
    case End::TimedOut:
    case End::OutOfMemory:
    case End::TooMuchOutput:
      return failure(task.kind, task.remedyAtLimit.empty() ? task.remedy : task.remedyAtLimit);
    case End::Exited:
      if (child.status == 0) return {};
      if (child.status == kNotLoaded)
        return error(ErrorKind::Failed, "{} could not be started ({}); {}", task.name,
                     split(child.err, '\n').front(), kIncomplete);
      if (child.status == static_cast<int>(ErrorKind::Input) && !child.err.empty())
        return Error{task.kind, child.err};
      break;
    case End::Signalled:
      break;
  }
  return failure(task.kind, task.remedy);
}

}  // namespace

WorkerAnswer runWorker(const WorkerTask& task) {
  ChildOutput child = runChild(workerProgram(), task.arguments, task.input, task.limits);
  Status status = statusOf(child, task);
  if (child.end == ChildOutput::End::NotStarted) child.err.clear();  // our own words
  return {std::move(status), std::move(child.out), std::move(child.err)};
}

std::filesystem::path workerProgram() {
  if (const char* named = std::getenv("LUCERNA_WORKER"); named && *named) return named;
  return (ownFile().parent_path() / LUCERNA_WORKER_FOLDER / "lucerna_worker").lexically_normal();
}

}  // namespace lucerna
