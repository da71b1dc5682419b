#include "core/log.hpp"

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <atomic>

namespace lucerna::log {
namespace {

std::atomic<int> warnings{0};

spdlog::logger& logger() {
  static const std::shared_ptr<spdlog::logger> instance = [] {
    auto made = std::make_shared<spdlog::logger>(
        "lucerna", std::make_shared<spdlog::sinks::stderr_color_sink_mt>());
    made->set_pattern("%^%l:%$ %v");
    return made;
  }();
  return *instance;
}

spdlog::level::level_enum spdlogLevel(Level level) {
  switch (level) {
    case Level::Debug:
      return spdlog::level::debug;
    case Level::Info:
      return spdlog::level::info;
    case Level::Warning:
      return spdlog::level::warn;
    case Level::Error:
      return spdlog::level::err;
    case Level::Off:
      return spdlog::level::off;
  }
  return spdlog::level::off;
}

}  // namespace

void setLevel(Level level) {
  logger().set_level(spdlogLevel(level));
}

void write(Level level, std::string_view message) {
  if (level >= Level::Warning) ++warnings;
  logger().log(spdlogLevel(level), "{}", message);
}

int warningCount() {
  return warnings;
}

}  // namespace lucerna::log
