#include "app/bench/process_memory.hpp"

#include <malloc.h>

#include <fstream>
#include <string>

namespace lucerna::app::bench {
namespace {

// Of /proc/self/status: "VmRSS:     1234 kB"
std::uint64_t statusBytes(const std::string& name) {
  std::ifstream file("/proc/self/status");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with(name + ":")) return 1024 * std::stoull(line.substr(name.size() + 1));
  return 0;
}

}  // namespace

std::uint64_t residentBytes() {
  return statusBytes("VmRSS");
}

std::uint64_t peakResidentBytes() {
  return statusBytes("VmHWM");
}

bool forgetPeak() {
  malloc_trim(0);
  std::ofstream file("/proc/self/clear_refs");
  file << "5";  // see proc(5)
  return static_cast<bool>(file.flush());
}

}  // namespace lucerna::app::bench
