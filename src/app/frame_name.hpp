// The name that -o gives: one file, one a frame through a %04d, or a video of all frames.
#pragma once

#include <string>

#include "core/numbered_path.hpp"

namespace lucerna::app {

enum class OutputKind { Png, Exr, Hdr, Video };

class FrameName {
 public:
  // pattern: "out.png", "frame-%04d.png" or "out.mp4". Several frames need a number or a video, a
  // video has no number. Errors: ErrorKind::Usage.
  static Result<FrameName> parse(const std::string& pattern, std::uint64_t frames);

  std::filesystem::path at(std::uint64_t frame) const { return path_.at(frame); }
  OutputKind kind() const { return kind_; }
  const std::string& pattern() const { return pattern_; }  // as given

 private:
  FrameName(std::string pattern, NumberedPath path, OutputKind kind)
      : pattern_(std::move(pattern)), path_(std::move(path)), kind_(kind) {}

  std::string pattern_;
  NumberedPath path_;
  OutputKind kind_;
};

}  // namespace lucerna::app
