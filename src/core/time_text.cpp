#include "core/time_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace lucerna {
namespace {

// "3 min 5 s"; of the smaller unit nothing if there is none.
std::string twoUnits(long long count, long long each, const char* large, const char* small) {
  const std::string text = fmt::format("{} {}", count / each, large);
  return count % each == 0 ? text : fmt::format("{} {} {}", text, count % each, small);
}

}  // namespace

std::string secondsText(double seconds) {
  if (seconds < 0.05) return "under 0.1 s";
  if (seconds < 9.95) return fmt::format("{:g} s", std::round(10. * seconds) / 10.);
  const long long whole = std::llround(seconds), minutes = std::llround(seconds / 60.);
  if (whole < 120) return fmt::format("{} s", whole);
  if (whole < 3600) return twoUnits(whole, 60, "min", "s");
  if (minutes < 48 * 60) return twoUnits(minutes, 60, "h", "min");
  return twoUnits(std::llround(seconds / 3600.), 24, "d", "h");
}

std::string aboutText(double seconds, double margin) {
  if (margin > seconds) return "at most " + secondsText(seconds + margin);
  const std::string about = "about " + secondsText(std::max(seconds, 0.05));
  if (seconds >= 9.95) margin = std::round(margin);
  return margin < 0.05 ? about : fmt::format("{}, give or take {}", about, secondsText(margin));
}

}  // namespace lucerna
