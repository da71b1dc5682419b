// Internal to graph/: finds what each input is bound to. Knows nothing of severity or order of
// reports; validate.cpp turns its problems into faults.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "graph/validate.hpp"

namespace lucerna::graph {

struct Problem {
  FaultKind kind;
  std::string found, wanted, remedy;
};

struct Binding {
  Source source;
  bool explicitlyBound = false;
  std::optional<Problem> problem;  // an error: the source is of no use
  std::optional<Problem> warning;
};

class Wiring {
 public:
  // descriptions: as pipeline.passes; none where the type is unknown. All must outlive the Wiring.
  Wiring(const Pipeline& pipeline, const Registry& registry,
         const std::vector<std::optional<PassDescription>>& descriptions)
      : pipeline_(pipeline), registry_(registry), descriptions_(descriptions) {}

  // What input `port` of a row is bound to.
  const Binding& input(std::size_t row, const PortDescription& port);

  // What "Row.port" means; a bare "Row" means its port `defaultPort`. The problem's kind is
  // UnknownPort or DisabledWithoutStandIn.
  Binding named(const std::string& name, const std::string& defaultPort);

  // The last enabled row's texture `port`.
  Binding last(const std::string& port);

 private:
  Binding byName(std::size_t row, const PortDescription& port);
  std::optional<Problem> producerChange(std::size_t disabledRow, const PortDescription& port,
                                        const Source& producer);
  std::optional<Problem> madeLater(std::size_t row, const PortDescription& port) const;
  Problem laterMaker(std::size_t row, std::size_t later, const PortDescription& port) const;
  Problem missing(std::size_t row, const PortDescription& port,
                  const std::vector<std::size_t>& disabled);
  Source output(std::size_t row, const PortDescription& port);
  // Whether an output is an update that found what to update.
  bool updatesSomething(std::size_t row, const PortDescription& output);
  PortType typeOf(std::size_t row, const PortDescription& output);
  std::optional<Source> standIn(std::size_t row, const PortDescription& output);
  Source fill(std::size_t row, const PortDescription& output, vec4 value);
  std::optional<std::size_t> findRow(std::string_view name) const;
  Problem unknownRow(const std::string& name) const;
  Problem unknownOutput(std::size_t row, const std::string& port) const;
  const PortDescription* outputOf(std::size_t row, std::string_view port) const;
  std::string nameOf(std::size_t row) const { return pipeline_.passes[row].name; }

  const Pipeline& pipeline_;
  const Registry& registry_;
  const std::vector<std::optional<PassDescription>>& descriptions_;
  std::map<std::pair<std::size_t, std::string>, Binding> inputs_;  // found so far
  std::set<std::pair<std::size_t, std::string>> inProgress_;       // ends circles of stand-ins
};

}  // namespace lucerna::graph
