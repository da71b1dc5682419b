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
  // Of several views each has a file of its own: "frame-%04d-view1.png".
  NumberedPath ofView(int view) const;
  // Whether a name of this and one of `other`'s, both with numbers below `count`, are the same.
  bool meets(const NumberedPath& other, std::uint64_t count) const;

 private:
  bool names(const std::string& path, std::uint64_t count) const;

  std::string before_, after_;
  int digits_ = -1;  // -1: no number in the name
};

}  // namespace lucerna
