#include "graph/row_check.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/text.hpp"
#include "graph/value_check.hpp"

namespace lucerna::graph {
namespace {

using gpu::FormatClass;

class Checker {
 public:
  Checker(const Pipeline& pipeline, std::size_t index, const Registry& registry,
          const gpu::Capabilities& capabilities)
      : pipeline_(pipeline),
        row_(pipeline.passes[index]),
        place_(rowPlace(pipeline, index)),
        registry_(registry),
        capabilities_(capabilities) {}

  RowCheck run() {
    const PassType* type = registry_.find(row_.type);
    if (!type) {
      if (row_.type.empty() && !pipeline_.formFaults.empty()) return std::move(check_);  // told
      type = likelyType();
      if (!type) return std::move(check_);
      check_.description = type->describe({});
      return std::move(check_);
    }
    check_.description = describeChecked(*type, row_.params);
    const PassDescription& description = *check_.description;
    for (const DescriptionFault& fault : description.faults)
      report(FaultKind::UnusableValue, fmt::format("{}, parameter '{}'", place_, fault.param),
             fault.found, fault.wanted, fault.remedy);
    checkParams(description);
    checkDeclaration(description);
    if (description.faults.empty()) checkReads(description);
    if (row_.enabled) checkCapabilities(description);
    return std::move(check_);
  }

 private:
  void report(FaultKind kind, std::string place, std::string found, std::string wanted,
              std::string remedy) {
    check_.faults.push_back({.kind = kind,
                             .place = std::move(place),
                             .found = std::move(found),
                             .wanted = std::move(wanted),
                             .remedy = std::move(remedy)});
  }

  const PassType* likelyType() {
    const std::vector<std::string> types = registry_.typeNames();
    const std::string near = closest(row_.type, types);
    report(FaultKind::UnknownPass, place_, fmt::format("the pass type '{}'", row_.type),
           "a type that `lucerna pass list` names, or one that a --plugin brings",
           near.empty() ? fmt::format("there are: {}", join(types))
                        : fmt::format("did you mean '{}'?", near));
    return near.empty() ? nullptr : registry_.find(near);
  }

  void checkParams(const PassDescription& description) {
    std::vector<std::string> names;
    for (const ParamDescription& param : description.params) names.push_back(param.name);
    for (const auto& [name, value] : row_.params) {
      const std::string place = fmt::format("{}, parameter '{}'", place_, name);
      const ParamDescription* param = description.param(name);
      if (!param && !description.faults.empty()) continue;  // it may be one that is missing
      if (!param) {
        const std::string near = closest(name, names);
        report(FaultKind::UnknownParameter, place,
               fmt::format("a parameter that {} does not have", row_.type),
               names.empty() ? "none: the pass has no parameters"
                             : fmt::format("one of {}", join(names)),
               near.empty() ? "remove it" : fmt::format("did you mean '{}'?", near));
      } else if (const auto fault = checkValue(*param, value)) {
        report(fault->wrongType ? FaultKind::WrongValueType : FaultKind::ValueOutOfRange, place,
               fault->found, fault->wanted, fault->remedy);
      }
    }
  }

  // What a pass's author must get right.
  void checkDeclaration(const PassDescription& description) {
    for (const PortDescription& port : description.ports)
      if (port.makes() && port.type.texture)
        CHECK(port.type.texture->formats.size() == 1, "{}: output '{}' must name its one format",
              description.type, port.name);
  }

  void checkReads(const PassDescription& description) {
    std::vector<std::string> inputs;
    for (const PortDescription& port : description.ports)
      if (port.direction != Direction::Out) inputs.push_back(port.name);
    for (const auto& [port, from] : row_.reads) {
      if (description.input(port)) continue;
      const std::string near = closest(port, inputs);
      report(
          FaultKind::UnknownPort, fmt::format("{}, reads '{}'", place_, port),
          fmt::format("an input that {} does not have", row_.type),
          inputs.empty() ? "none: the pass has no inputs" : fmt::format("one of {}", join(inputs)),
          near.empty() ? "remove it" : fmt::format("did you mean '{}'?", near));
    }
  }

  void checkCapabilities(const PassDescription& description) {
    for (const std::string& feature : description.features)
      if (!capabilities_.features.contains(feature))
        report(FaultKind::MissingFeature, place_,
               fmt::format("{} has no '{}'", capabilities_.name, feature),
               fmt::format("'{}', which {} needs", feature, description.type),
               "disable the row, or use another driver");
    int colorTargets = 0;
    for (const PortDescription& port : description.ports) {
      if (port.direction == Direction::In || !port.type.texture) continue;
      const TextureSpec& spec = *port.type.texture;
      if (spec.formats.empty() || gpu::info(spec.formats[0]).kind != FormatClass::Depth)
        ++colorTargets;
      if (port.makes()) checkOutput(port, spec);
    }
    if (colorTargets > capabilities_.maxColorTargets)
      report(FaultKind::MissingFeature, place_,
             fmt::format("{} draws to at most {} colour targets", capabilities_.name,
                         capabilities_.maxColorTargets),
             fmt::format("{}, which {} writes", colorTargets, description.type),
             "disable the row, or use another driver");
  }

  void checkOutput(const PortDescription& port, const TextureSpec& spec) {
    const std::string place = fmt::format("{}, output '{}'", place_, port.name);
    const auto unsupported = [&](std::string found, std::string wanted) {
      report(FaultKind::UnsupportedFormat, place,
             fmt::format("{} {}", capabilities_.name, std::move(found)), std::move(wanted),
             "disable the row, or use another driver");
    };
    if (!capabilities_.renderable.contains(spec.formats[0]))
      unsupported("cannot draw to this format", std::string(gpu::info(spec.formats[0]).name));
    if (spec.samples > capabilities_.maxSamples)
      unsupported(fmt::format("has at most {} samples a pixel", capabilities_.maxSamples),
                  fmt::format("{} samples", spec.samples));
    const int side = std::max(port.size.width, port.size.height);
    if (port.size.kind == SizeRule::Kind::Absolute && side > capabilities_.maxTextureSide)
      unsupported(fmt::format("has textures of at most {} pixels", capabilities_.maxTextureSide),
                  fmt::format("{} x {} pixels", port.size.width, port.size.height));
  }

  const Pipeline& pipeline_;
  const PassRow& row_;
  const std::string place_;
  const Registry& registry_;
  const gpu::Capabilities& capabilities_;
  RowCheck check_;
};

}  // namespace

RowCheck checkRow(const Pipeline& pipeline, std::size_t row, const Registry& registry,
                  const gpu::Capabilities& capabilities) {
  return Checker(pipeline, row, registry, capabilities).run();
}

std::string rowPlace(const Pipeline& pipeline, std::size_t index) {
  const PassRow& row = pipeline.passes[index];
  return fmt::format("{}, pass '{}'",
                     row.place.empty() ? fmt::format("row {}", index + 1) : row.place, row.name);
}

std::optional<Problem> typeProblem(const PortDescription& input, const Source& source,
                                   const std::string& name) {
  const auto mismatch = [&](FaultKind kind) {
    const char* orElse = input.direction == Direction::InOut
                             ? "move this row before the pass that made it"
                             : "put a pass that converts it between";
    return Problem{.kind = kind,
                   .found = fmt::format("{}, {}", name, source.type.text()),
                   .wanted = input.type.text(),
                   .remedy = fmt::format("bind '{}' to another value by \"reads\", or {}",
                                         input.name, orElse)};
  };
  if (input.direction == Direction::InOut && source.kind == Source::Kind::Resource)
    return Problem{.kind = FaultKind::TypeMismatch,
                   .found = fmt::format("{}, which passes may not change", name),
                   .wanted = fmt::format("{} made by a pass", input.type.text()),
                   .remedy = "add before this one a pass that makes it"};
  const auto& wanted = input.type.texture;
  const auto& found = source.type.texture;
  if (wanted.has_value() != found.has_value()) return mismatch(FaultKind::TypeMismatch);
  if (!wanted)
    return input.type.data == source.type.data ? std::nullopt
                                               : std::optional(mismatch(FaultKind::TypeMismatch));
  if (wanted->kind != found->kind) return mismatch(FaultKind::TypeMismatch);
  if (wanted->formats.empty() || found->formats.empty()) return std::nullopt;
  const bool accepted = std::find(wanted->formats.begin(), wanted->formats.end(),
                                  found->formats[0]) != wanted->formats.end();
  return accepted ? std::nullopt : std::optional(mismatch(FaultKind::FormatMismatch));
}

}  // namespace lucerna::graph
