#include "core/numbered_path.hpp"

namespace lucerna {

Result<NumberedPath> NumberedPath::parse(const std::string& pattern) {
  NumberedPath name;
  std::string* part = &name.before_;
  for (std::size_t i = 0; i < pattern.size(); ++i) {
    if (pattern[i] != '%') {
      *part += pattern[i];
      continue;
    }
    std::size_t end = i + 1;
    if (end < pattern.size() && pattern[end] == '%') {
      *part += '%';
      i = end;
      continue;
    }
    int digits = 0;
    if (end + 1 < pattern.size() && pattern[end] == '0' && pattern[end + 1] >= '1' &&
        pattern[end + 1] <= '9') {
      digits = pattern[end + 1] - '0';
      end += 2;
    }
    if (end >= pattern.size() || pattern[end] != 'd' || name.numbered())
      return error(ErrorKind::Usage,
                   "'{}' has a '%' that is not a frame number; wanted one %d or %04d (and %% for a "
                   "percent sign)",
                   pattern);
    name.digits_ = digits;
    part = &name.after_;
    i = end;
  }
  return name;
}

std::filesystem::path NumberedPath::at(std::uint64_t number) const {
  if (!numbered()) return before_;
  return fmt::format("{}{:0{}}{}", before_, number, digits_, after_);
}

}  // namespace lucerna
