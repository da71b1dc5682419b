#include "core/worker_program.hpp"

#include <dlfcn.h>
#include <link.h>

#include <cstdlib>

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

}  // namespace

std::filesystem::path workerProgram() {
  if (const char* named = std::getenv("LUCERNA_WORKER"); named && *named) return named;
  return (ownFile().parent_path() / LUCERNA_WORKER_FOLDER / "lucerna_worker").lexically_normal();
}

}  // namespace lucerna
