// Internal to graph/: the faults that a row has by itself (type, values, names in `reads`, what the
// driver lacks), and the match of two port types.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "graph/wiring.hpp"

namespace lucerna::graph {

struct RowCheck {
  // None if the type is unknown and resembles no other: with a likely type, its readers are not
  // reported for the same slip.
  std::optional<PassDescription> description;
  std::vector<Fault> faults;
};

RowCheck checkRow(const Pipeline& pipeline, std::size_t row, const Registry& registry,
                  const gpu::Capabilities& capabilities);

// "deferred.js:12, pass 'Ao'".
std::string rowPlace(const Pipeline& pipeline, std::size_t row);

// None if the input can take the source, which messages call `name`.
std::optional<Problem> typeProblem(const PortDescription& input, const Source& source,
                                   const std::string& name);

}  // namespace lucerna::graph
