// Assertions for our own bugs, kept in release builds. Bad input never reaches a CHECK: it becomes
// an Error (core/result.hpp).
#pragma once

#include <fmt/format.h>

#include <string>

namespace lucerna {

[[noreturn]] void failCheck(const char* condition, const char* file, int line,
                            const std::string& message);

}  // namespace lucerna

// CHECK(condition) or CHECK(condition, "format {}", values...): prints both and aborts when false.
#define CHECK(condition, ...)                                                              \
  do {                                                                                     \
    if (!(condition)) [[unlikely]]                                                         \
      ::lucerna::failCheck(#condition, __FILE__, __LINE__, ::fmt::format("" __VA_ARGS__)); \
  } while (false)
