// Internal to graph/: how large a texture is, relative to the output. Known without the output's
// size, so that validation can compare.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "graph/validate.hpp"

namespace lucerna::graph {

struct SizeRelation {
  uvec2 absolute{0};               // px; (0, 0): the output's size
  std::vector<float> scales = {};  // one after the other, each rounded up; none is 1

  bool operator==(const SizeRelation&) const = default;
  uvec2 inPixels(uvec2 outputSize) const;
  std::string text() const;  // "0.5 x the output's size"
};

// Follows relations from row to row. The plan must outlive it; wiring with faults is no harm.
class SizeRelations {
 public:
  explicit SizeRelations(const Plan& plan) : plan_(plan) {}
  SizeRelation of(const Source& source);

 private:
  SizeRelation ofOutput(std::size_t row, const std::string& port);

  const Plan& plan_;
  std::map<std::pair<std::size_t, std::string>, SizeRelation> known_;
};

}  // namespace lucerna::graph
