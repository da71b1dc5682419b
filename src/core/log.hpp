// Talk goes to stderr; stdout is for data. Levels are set once by --quiet and --verbose.
#pragma once

#include <fmt/format.h>

#include <string_view>
#include <utility>

namespace lucerna::log {

enum class Level { Debug, Info, Warning, Error, Off };

void setLevel(Level level);
void write(Level level, std::string_view message);

// Number of warnings and errors written since the start; tests read it.
int warningCount();

template <typename... Args>
void debug(fmt::format_string<Args...> format, Args&&... args) {
  write(Level::Debug, fmt::format(format, std::forward<Args>(args)...));
}
template <typename... Args>
void info(fmt::format_string<Args...> format, Args&&... args) {
  write(Level::Info, fmt::format(format, std::forward<Args>(args)...));
}
template <typename... Args>
void warning(fmt::format_string<Args...> format, Args&&... args) {
  write(Level::Warning, fmt::format(format, std::forward<Args>(args)...));
}
template <typename... Args>
void error(fmt::format_string<Args...> format, Args&&... args) {
  write(Level::Error, fmt::format(format, std::forward<Args>(args)...));
}

}  // namespace lucerna::log
