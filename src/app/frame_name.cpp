#include "app/frame_name.hpp"

#include <array>
#include <utility>
#include <vector>

#include "core/text.hpp"

namespace lucerna::app {
namespace {

constexpr std::array<std::pair<const char*, OutputKind>, 5> kExtensions{
    {{".png", OutputKind::Png},
     {".exr", OutputKind::Exr},
     {".hdr", OutputKind::Hdr},
     {".mp4", OutputKind::Video},
     {".mkv", OutputKind::Video}}};

Result<OutputKind> kindOf(const std::string& pattern) {
  const std::string extension = std::filesystem::path(pattern).extension().string();
  std::vector<std::string> known;
  for (const auto& [name, kind] : kExtensions) {
    if (equalIgnoringCase(extension, name)) return kind;
    known.emplace_back(name);
  }
  return error(ErrorKind::Usage, "-o: '{}' ends in '{}'{}; pictures and videos are written as {}",
               pattern, extension, didYouMean(extension, known), join(known));
}

}  // namespace

Result<FrameName> FrameName::parse(const std::string& pattern, std::uint64_t frames) {
  LUCERNA_TRY(kind, kindOf(pattern));
  auto path = NumberedPath::parse(pattern);
  if (!path) return error(ErrorKind::Usage, "-o: {}", path.error().message);
  const bool video = kind == OutputKind::Video;
  if (video && path->numbered())
    return error(ErrorKind::Usage, "-o: '{}' is one file; leave the frame number out", pattern);
  if (!video && frames > 1 && !path->numbered())
    return error(ErrorKind::Usage,
                 "-o: {} frames would all be written to '{}'; put a frame number into the name, "
                 "like frame-%04d.png",
                 frames, pattern);
  return FrameName(pattern, std::move(path).value(), kind);
}

}  // namespace lucerna::app
