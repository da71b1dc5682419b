#include "core/check.hpp"

#include <cstdio>
#include <cstdlib>

namespace lucerna {

void failCheck(const char* condition, const char* file, int line, const std::string& message) {
  std::fprintf(stderr, "%s:%d: check failed: %s%s%s\n", file, line, condition,
               message.empty() ? "" : ": ", message.c_str());
  std::abort();
}

}  // namespace lucerna
