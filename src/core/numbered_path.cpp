#include "core/numbered_path.hpp"

#include <charconv>

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

NumberedPath NumberedPath::ofView(int view) const {
  NumberedPath result = *this;
  std::string& end = numbered() ? result.after_ : result.before_;
  const std::size_t dot = end.rfind('.');
  end.insert(dot == std::string::npos ? end.size() : dot, fmt::format("-view{}", view));
  return result;
}

bool NumberedPath::meets(const NumberedPath& other, std::uint64_t count) const {
  for (std::uint64_t number = 0; number < (numbered() ? count : 1); ++number)
    if (other.names(at(number).string(), count)) return true;
  return false;
}

bool NumberedPath::names(const std::string& path, std::uint64_t count) const {
  if (!numbered()) return path == before_;
  if (!path.starts_with(before_)) return false;
  std::uint64_t number = 0;
  const char* begin = path.data() + before_.size();
  const auto [end, fault] = std::from_chars(begin, path.data() + path.size(), number);
  return fault == std::errc() && number < count && path == at(number);
}

}  // namespace lucerna
