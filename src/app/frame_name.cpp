#include "app/frame_name.hpp"

#include <array>
#include <utility>
#include <vector>

#include "core/text.hpp"

namespace lucerna::app {
namespace {

constexpr std::array<std::pair<const char*, OutputKind>, 3> kExtensions{
    {{".png", OutputKind::Png}, {".exr", OutputKind::Exr}, {".hdr", OutputKind::Hdr}}};

Result<OutputKind> kindOf(const std::string& pattern) {
  const std::string extension = std::filesystem::path(pattern).extension().string();
  std::vector<std::string> known;
  for (const auto& [name, kind] : kExtensions) {
    if (equalIgnoringCase(extension, name)) return kind;
    known.emplace_back(name);
  }
  return error(ErrorKind::Usage, "-o: '{}' ends in '{}'{}; pictures are written as {}", pattern,
               extension, didYouMean(extension, known), join(known));
}

}  // namespace

Result<FrameName> FrameName::parse(const std::string& pattern, std::uint64_t frames) {
  FrameName name;
  LUCERNA_TRY(kind, kindOf(pattern));
  name.kind_ = kind;
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
    if (end >= pattern.size() || pattern[end] != 'd' || name.digits_ >= 0)
      return error(ErrorKind::Usage,
                   "-o: '{}' has a '%' that is not a frame number; wanted one %d or %04d (and %% "
                   "for a percent sign)",
                   pattern);
    name.digits_ = digits;
    part = &name.after_;
    i = end;
  }
  if (frames > 1 && name.digits_ < 0)
    return error(ErrorKind::Usage,
                 "-o: {} frames would all be written to '{}'; put a frame number into the name, "
                 "like frame-%04d.png",
                 frames, pattern);
  return name;
}

std::filesystem::path FrameName::at(std::uint64_t frame) const {
  if (digits_ < 0) return before_;
  return fmt::format("{}{:0{}}{}", before_, frame, digits_, after_);
}

}  // namespace lucerna::app
