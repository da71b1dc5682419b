#include "graph/wiring.hpp"

#include <fmt/format.h>

#include "core/text.hpp"

namespace lucerna::graph {
namespace {

Binding faulty(Problem problem) {
  Binding binding;
  binding.problem = std::move(problem);
  return binding;
}

Binding bound(Source source) {
  Binding binding;
  binding.source = std::move(source);
  return binding;
}

Source resourceSource(const ResourceDescription& resource) {
  Source source;
  source.kind = Source::Kind::Resource;
  source.port = resource.name;
  source.type = resource.type;
  source.perView = resource.perView;
  return source;
}

}  // namespace

const Binding& Wiring::input(std::size_t row, const PortDescription& port) {
  const std::pair key(row, port.name);
  if (const auto known = inputs_.find(key); known != inputs_.end()) return known->second;
  static const Binding circle = faulty({.kind = FaultKind::Cycle,
                                        .found = "disabled passes that repeat each other's values",
                                        .wanted = "a value that some pass makes",
                                        .remedy = "change `reads` of one of them"});
  if (!inProgress_.insert(key).second) return circle;
  const auto& reads = pipeline_.passes[row].reads;
  const auto given = reads.find(port.name);
  Binding binding = given == reads.end() ? byName(row, port) : named(given->second, port.name);
  binding.explicitlyBound = given != reads.end();
  inProgress_.erase(key);
  return inputs_.emplace(key, std::move(binding)).first->second;
}

Binding Wiring::named(const std::string& name, const std::string& defaultPort) {
  const std::size_t dot = name.find('.');
  const std::string rowName = name.substr(0, dot);
  const std::string port = dot == std::string::npos ? defaultPort : name.substr(dot + 1);
  const auto row = findRow(rowName);
  if (!row) {
    if (dot == std::string::npos)
      if (const ResourceDescription* resource = registry_.resource(name))
        return bound(resourceSource(*resource));
    return faulty(unknownRow(name));
  }
  if (!descriptions_[*row]) return {};  // its type is unknown, which is a fault of its own
  const PortDescription* out = outputOf(*row, port);
  if (!out) return faulty(unknownOutput(*row, port));
  if (pipeline_.passes[*row].enabled) return bound(output(*row, *out));
  if (auto source = standIn(*row, *out)) return bound(std::move(*source));
  return faulty(
      {.kind = FaultKind::DisabledWithoutStandIn,
       .found = fmt::format("'{}' is disabled and its output '{}' has no stand-in", rowName, port),
       .wanted = "an enabled pass, or one whose output states a value when disabled",
       .remedy = fmt::format("enable '{}' or name another pass", rowName)});
}

Binding Wiring::last(const std::string& port) {
  for (std::size_t row = pipeline_.passes.size(); row-- > 0;) {
    const PortDescription* out = outputOf(row, port);
    if (out && out->type.texture && pipeline_.passes[row].enabled) return bound(output(row, *out));
  }
  return faulty({.kind = FaultKind::BadOutput,
                 .found = fmt::format("no enabled pass with an output '{}'", port),
                 .wanted = "a texture to show",
                 .remedy = "add a pass that makes one, or set \"output\": \"Pass.port\""});
}

Binding Wiring::byName(std::size_t row, const PortDescription& port) {
  std::vector<std::size_t> disabled;  // nearest first
  for (std::size_t i = row; i-- > 0;) {
    const PortDescription* out = outputOf(i, port.name);
    if (!out) continue;
    if (pipeline_.passes[i].enabled) {
      Binding binding = bound(output(i, *out));
      if (!disabled.empty())
        binding.warning = producerChange(disabled.front(), port, binding.source);
      return binding;
    }
    disabled.push_back(i);
  }
  for (const std::size_t i : disabled)
    if (auto source = standIn(i, *outputOf(i, port.name))) return bound(std::move(*source));
  if (const ResourceDescription* resource = registry_.resource(port.name))
    return bound(resourceSource(*resource));
  if (port.history)  // last frame's value may be made by this row or a later one
    for (std::size_t i = row; i < pipeline_.passes.size(); ++i)
      if (const PortDescription* out = outputOf(i, port.name); out && pipeline_.passes[i].enabled)
        return bound(output(i, *out));
  if (port.history) return {};
  if (port.optional) {
    Binding none;
    none.warning = madeLater(row, port);
    return none;
  }
  return faulty(missing(row, port, disabled));
}

// An update without what it updates begins anew; an input that is only read goes without.
std::optional<Problem> Wiring::madeLater(std::size_t row, const PortDescription& port) const {
  if (port.direction != Direction::In) return std::nullopt;
  for (std::size_t i = row + 1; i < pipeline_.passes.size(); ++i)
    if (outputOf(i, port.name) && pipeline_.passes[i].enabled) return laterMaker(row, i, port);
  return std::nullopt;
}

Problem Wiring::laterMaker(std::size_t row, std::size_t later, const PortDescription& port) const {
  return {.kind = port.optional ? FaultKind::MadeLater : FaultKind::MissingInput,
          .found = fmt::format("only a later pass, '{}', makes '{}'", nameOf(later), port.name),
          .wanted = port.type.text(),
          .remedy = fmt::format("move '{}' before '{}'", nameOf(later), nameOf(row))};
}

std::optional<Problem> Wiring::producerChange(std::size_t disabledRow, const PortDescription& port,
                                              const Source& producer) {
  const auto source = standIn(disabledRow, *outputOf(disabledRow, port.name));
  if (!source || source->sameAs(producer)) return std::nullopt;
  const std::string stand = source->kind == Source::Kind::Fill
                                ? fmt::format("the constant ({}, {}, {}, {})", source->fill.x,
                                              source->fill.y, source->fill.z, source->fill.w)
                            : source->kind == Source::Kind::Output
                                ? fmt::format("'{}.{}'", nameOf(source->row), source->port)
                                : fmt::format("the resource '{}'", source->port);
  return Problem{.kind = FaultKind::ProducerChanged,
                 .found = fmt::format("'{}.{}', because '{}', which stands nearer, is disabled",
                                      nameOf(producer.row), producer.port, nameOf(disabledRow)),
                 .wanted = fmt::format("what stands in for '{}': {}", nameOf(disabledRow), stand),
                 .remedy = fmt::format("to have that, set \"reads\": {{\"{}\": \"{}\"}}; to keep "
                                       "this silently, set it to \"{}\"",
                                       port.name, nameOf(disabledRow), nameOf(producer.row))};
}

Problem Wiring::missing(std::size_t row, const PortDescription& port,
                        const std::vector<std::size_t>& disabled) {
  const std::string wanted = port.type.text();
  if (!disabled.empty())
    return {.kind = FaultKind::DisabledWithoutStandIn,
            .found = fmt::format("only '{}' makes '{}', and it is disabled without a stand-in",
                                 nameOf(disabled.front()), port.name),
            .wanted = wanted,
            .remedy = fmt::format("enable '{}', or disable '{}' too", nameOf(disabled.front()),
                                  nameOf(row))};
  for (std::size_t i = row; i < pipeline_.passes.size(); ++i)
    if (i != row && outputOf(i, port.name) && pipeline_.passes[i].enabled)
      return laterMaker(row, i, port);
  std::vector<std::string> makers;
  for (const std::string& type : registry_.typeNames())
    if (type != pipeline_.passes[row].type) {
      const PassDescription description = registry_.find(type)->describe({});
      const PortDescription* out = description.output(port.name);
      if (out && out->makes()) makers.push_back(type);
    }
  return {
      .kind = FaultKind::MissingInput,
      .found = fmt::format("no earlier pass and no resource gives '{}'", port.name),
      .wanted = wanted,
      .remedy =
          makers.empty()
              ? fmt::format("name what to read: \"reads\": {{\"{}\": \"Pass.port\"}}", port.name)
              : fmt::format("add before '{}' a pass that makes it: {}", nameOf(row), join(makers))};
}

Source Wiring::output(std::size_t row, const PortDescription& port) {
  Source source;
  source.kind = Source::Kind::Output;
  source.row = row;
  source.port = port.name;
  source.type = typeOf(row, port);
  return source;
}

// An update has the type of what it updates.
PortType Wiring::typeOf(std::size_t row, const PortDescription& output) {
  return updatesSomething(row, output) ? input(row, output).source.type : output.type;
}

bool Wiring::updatesSomething(std::size_t row, const PortDescription& output) {
  if (output.direction != Direction::InOut) return false;
  const Binding& updated = input(row, output);
  return !updated.problem && updated.source.kind != Source::Kind::Unbound;
}

std::optional<Source> Wiring::standIn(std::size_t row, const PortDescription& output) {
  const bool repeatsItself =
      output.direction == Direction::InOut &&
      (output.standIn.kind == StandIn::Kind::None || updatesSomething(row, output));
  if (repeatsItself || output.standIn.kind == StandIn::Kind::PassThrough) {
    const std::string& name = repeatsItself ? output.name : output.standIn.input;
    const PortDescription* repeated = descriptions_[row]->input(name);
    CHECK(repeated, "{}: output '{}' repeats an input '{}' that the pass does not have",
          descriptions_[row]->type, output.name, name);
    const Binding& binding = input(row, *repeated);
    if (binding.problem || binding.source.kind == Source::Kind::Unbound) return std::nullopt;
    return binding.source;
  }
  if (output.standIn.kind == StandIn::Kind::Fill) return fill(row, output, output.standIn.fill);
  return std::nullopt;
}

Source Wiring::fill(std::size_t row, const PortDescription& output, vec4 value) {
  Source source;
  source.kind = Source::Kind::Fill;
  source.row = row;
  source.port = output.name;
  source.fill = value;
  source.type = typeOf(row, output);
  source.size = output.size;
  if (updatesSomething(row, output))
    source.size = {.kind = SizeRule::Kind::Port, .port = output.name};
  if (source.size.kind != SizeRule::Kind::Port) return source;
  const float scale = source.size.scale;
  const PortDescription* like = descriptions_[row]->input(source.size.port);
  const Source base = like ? input(row, *like).source : Source{};
  source.size = {.kind = SizeRule::Kind::Output, .scale = scale};
  if (base.kind == Source::Kind::Output) {
    source.size = {.kind = SizeRule::Kind::Port, .port = base.port, .scale = scale};
    source.sizeRow = base.row;
  } else if (base.kind == Source::Kind::Fill) {
    source.size = base.size;
    source.size.scale *= scale;
    source.sizeRow = base.sizeRow;
  }
  return source;
}

std::optional<std::size_t> Wiring::findRow(std::string_view name) const {
  for (std::size_t i = 0; i < pipeline_.passes.size(); ++i)
    if (pipeline_.passes[i].name == name) return i;
  return std::nullopt;
}

Problem Wiring::unknownRow(const std::string& name) const {
  std::vector<std::string> names;
  for (const PassRow& row : pipeline_.passes) names.push_back(row.name);
  for (const ResourceDescription& resource : registry_.resources()) names.push_back(resource.name);
  const std::string near = closest(name.substr(0, name.find('.')), names);
  return {.kind = FaultKind::UnknownPort,
          .found = fmt::format("'{}', and no pass or resource has that name", name),
          .wanted = "\"Pass.port\" of a row of this pipeline, or a resource",
          .remedy = near.empty() ? fmt::format("there are: {}", join(names))
                                 : fmt::format("did you mean '{}'?", near)};
}

Problem Wiring::unknownOutput(std::size_t row, const std::string& port) const {
  std::vector<std::string> names;
  for (const PortDescription& p : descriptions_[row]->ports)
    if (p.direction != Direction::In) names.push_back(p.name);
  const std::string near = names.size() == 1 ? names[0] : closest(port, names);
  return {
      .kind = FaultKind::UnknownPort,
      .found = fmt::format("'{}.{}', and '{}' has no such output", nameOf(row), port, nameOf(row)),
      .wanted = names.empty() ? "a pass with outputs"
                              : fmt::format("one of its outputs: {}", join(names)),
      .remedy = near.empty() ? "name an output"
                             : fmt::format("did you mean '{}.{}'?", nameOf(row), near)};
}

const PortDescription* Wiring::outputOf(std::size_t row, std::string_view port) const {
  return descriptions_[row] ? descriptions_[row]->output(port) : nullptr;
}

}  // namespace lucerna::graph
