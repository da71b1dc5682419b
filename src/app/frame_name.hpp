// Names of output files: one file, or one a frame through a %04d.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "core/result.hpp"

namespace lucerna::app {

enum class OutputKind { Png, Exr, Hdr };

class FrameName {
 public:
  // pattern: "out.png", or "frame-%04d.png" with one %d or %0Nd (N from 1 to 9); %% is a percent
  // sign. Several frames need a number, one frame may have it. Errors: ErrorKind::Usage.
  static Result<FrameName> parse(const std::string& pattern, std::uint64_t frames);

  std::filesystem::path at(std::uint64_t frame) const;
  OutputKind kind() const { return kind_; }

 private:
  std::string before_, after_;
  int digits_ = -1;  // -1: no number in the name
  OutputKind kind_ = OutputKind::Png;
};

}  // namespace lucerna::app
