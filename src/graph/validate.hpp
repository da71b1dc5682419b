// Checks a pipeline against the registry and a driver's capabilities, and resolves its wiring. No
// GL. The rules of binding are a table in docs/dev/graph.md.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gpu/capabilities.hpp"
#include "graph/fault.hpp"
#include "graph/pipeline.hpp"
#include "graph/registry.hpp"

namespace lucerna::graph {

// Where an input's value comes from.
struct Source {
  enum class Kind { Unbound, Output, Resource, Fill } kind = Kind::Unbound;
  std::size_t row =
      0;               // Output: index in Pipeline::passes; Fill: the disabled row it stands in for
  std::string port{};  // Output, Fill: the output port; Resource: its name
  vec4 fill{0.f};
  PortType type;
  // Fill: size of what it stands in for; of Kind::Port: of the output `size.port` of row `sizeRow`.
  SizeRule size;
  std::size_t sizeRow = 0;
  bool perView = false;  // Resource

  bool sameAs(const Source& other) const {
    return kind == other.kind && row == other.row && port == other.port;
  }
};

struct ResolvedInput {
  std::string port{};
  Source source;
  bool explicitlyBound = false;  // by `reads`
};

struct ResolvedRow {
  std::size_t row = 0;  // index in Pipeline::passes
  std::string name{};   // of the row
  PassDescription description;
  std::vector<ResolvedInput> inputs{};  // In and InOut ports, in the description's order
  bool culled = false;

  const ResolvedInput* input(std::string_view port) const;
  // Whether the port is an update that has something to update.
  bool updates(const PortDescription& port) const;
};

// The wiring of a valid pipeline: the enabled rows in list order.
struct Plan {
  std::vector<ResolvedRow> rows{};
  Source output;
  std::vector<Source> kept{};            // further values that must survive to the frame's end
  std::vector<std::string> keptNames{};  // as asked for
  std::vector<std::string> rowNames{};   // of all rows of the pipeline, also the disabled
};

struct Validation {
  std::vector<Fault> faults{};  // errors and warnings, in the order of the rows
  std::optional<Plan> plan;     // absent if there is an error
  bool ok() const { return plan.has_value(); }
  std::string text() const;  // all faults, one paragraph each
};

// kept: further outputs wanted beside the pipeline's own ("GBuffer.depth"), which also keep their
// passes from being culled.
Validation validate(const Pipeline& pipeline, const Registry& registry,
                    const gpu::Capabilities& capabilities,
                    const std::vector<std::string>& kept = {});

}  // namespace lucerna::graph
