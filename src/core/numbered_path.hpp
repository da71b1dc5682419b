// A file name with a place for a frame number: "frame-%04d.png".
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "core/result.hpp"

namespace lucerna {

class NumberedPath {
 public:
  // pattern: at most one %d or %0Nd (N from 1 to 9); %% is a percent sign. Errors:
  // ErrorKind::Usage.
  static Result<NumberedPath> parse(const std::string& pattern);

  bool numbered() const { return digits_ >= 0; }
  // The same for every number if the name has no place for it.
  std::filesystem::path at(std::uint64_t number) const;

 private:
  std::string before_, after_;
  int digits_ = -1;  // -1: no number in the name
};

}  // namespace lucerna
