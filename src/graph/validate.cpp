#include "graph/validate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "core/text.hpp"
#include "graph/row_check.hpp"
#include "graph/size_relation.hpp"
#include "graph/wiring.hpp"

namespace lucerna::graph {
namespace {

bool isOutput(const PortDescription& port) {
  return port.direction != Direction::In;
}
bool isInput(const PortDescription& port) {
  return port.direction != Direction::Out;
}
bool isMade(const Source& source) {
  return source.kind == Source::Kind::Output || source.kind == Source::Kind::Fill;
}

// Steps run by frequency, then in list order.
std::pair<Frequency, std::size_t> runOrder(const ResolvedRow& row) {
  return {row.description.frequency, row.row};
}

class Validator {
 public:
  Validator(const Pipeline& pipeline, const Registry& registry,
            const gpu::Capabilities& capabilities)
      : pipeline_(pipeline),
        registry_(registry),
        capabilities_(capabilities),
        descriptions_(pipeline.passes.size()),
        wiring_(pipeline, registry, descriptions_) {}

  Validation run(const std::vector<std::string>& kept) {
    checkRows();
    for (std::size_t i = 0; i < pipeline_.passes.size(); ++i)
      if (pipeline_.passes[i].enabled && descriptions_[i]) resolveRow(i);
    checkOrder();
    checkSizes();
    resolveOutputs(kept);
    cull();
    checkUpdates();
    std::stable_sort(faults_.begin(), faults_.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    Validation result;
    result.faults = pipeline_.formFaults;
    bool good = pipeline_.formFaults.empty();
    for (auto& [row, fault] : faults_) {
      good = good && fault.severity == Severity::Warning;
      result.faults.push_back(std::move(fault));
    }
    if (good) result.plan = std::move(plan_);
    return result;
  }

 private:
  static constexpr std::size_t kPipeline = ~std::size_t{0};  // place of faults of no row

  std::string place(std::size_t row) const {
    if (row == kPipeline)
      return pipeline_.source.empty() ? "pipeline '" + pipeline_.name + "'" : pipeline_.source;
    return rowPlace(pipeline_, row);
  }
  std::string inputPlace(std::size_t row, const std::string& port) const {
    return fmt::format("{}, input '{}'", place(row), port);
  }
  void report(std::size_t row, std::string where, Problem problem,
              Severity severity = Severity::Error) {
    faults_.emplace_back(row, Fault{.kind = problem.kind,
                                    .severity = severity,
                                    .place = std::move(where),
                                    .found = std::move(problem.found),
                                    .wanted = std::move(problem.wanted),
                                    .remedy = std::move(problem.remedy)});
  }

  void checkRows() {
    std::map<std::string, std::size_t> names;
    bool anyEnabled = false;
    for (std::size_t i = 0; i < pipeline_.passes.size(); ++i) {
      const PassRow& row = pipeline_.passes[i];
      anyEnabled = anyEnabled || row.enabled;
      plan_.rowNames.push_back(row.name);
      if (const auto [first, isNew] = names.emplace(row.name, i); !isNew)
        report(i, place(i),
               {.kind = FaultKind::DuplicateName,
                .found = fmt::format("the name '{}', which {} has too", row.name,
                                     rowPlace(pipeline_, first->second)),
                .wanted = "a name of its own for every row",
                .remedy = fmt::format("give one a \"name\", such as '{}2'", row.name)});
      RowCheck check = checkRow(pipeline_, i, registry_, capabilities_);
      descriptions_[i] = std::move(check.description);
      wiringKnown_ = wiringKnown_ && descriptions_[i] && descriptions_[i]->faults.empty();
      for (Fault& fault : check.faults) faults_.emplace_back(i, std::move(fault));
    }
    if (!anyEnabled)
      report(kPipeline, place(kPipeline),
             {.kind = FaultKind::EmptyPipeline,
              .found = pipeline_.passes.empty() ? "no passes" : "only disabled passes",
              .wanted = "at least one enabled pass",
              .remedy = "add a row {\"type\": \"...\"}, or enable one"});
  }

  void resolveRow(std::size_t index) {
    ResolvedRow resolved{
        .row = index, .name = pipeline_.passes[index].name, .description = *descriptions_[index]};
    for (const PortDescription& port : resolved.description.ports) {
      if (!isInput(port)) continue;
      const Binding& binding = wiring_.input(index, port);
      const std::string where = inputPlace(index, port.name);
      if (binding.problem) report(index, where, *binding.problem);
      wiringKnown_ = wiringKnown_ && !binding.problem;
      if (binding.warning) report(index, where, *binding.warning, Severity::Warning);
      if (!binding.problem) checkBinding(index, port, binding.source);
      resolved.inputs.push_back({.port = port.name,
                                 .source = binding.problem ? Source{} : binding.source,
                                 .explicitlyBound = binding.explicitlyBound});
    }
    plan_.rows.push_back(std::move(resolved));
  }

  void checkBinding(std::size_t index, const PortDescription& port, const Source& source) {
    if (source.kind == Source::Kind::Unbound) return;
    const std::string where = inputPlace(index, port.name);
    const std::string name = sourceText(source);
    if (auto problem = typeProblem(port, source, name)) return report(index, where, *problem);
    const Frequency reader = descriptions_[index]->frequency;
    Frequency writer = Frequency::PerScene;
    if (source.kind == Source::Kind::Output)
      writer = descriptions_[source.row]->frequency;
    else if (source.perView)
      writer = Frequency::PerView;
    if (writer > reader)
      report(index, where,
             {.kind = FaultKind::WrongFrequency,
              .found = fmt::format("{}, which is made {}", name, graph::nameOf(writer)),
              .wanted = fmt::format("a value made {} or more seldom, as the pass runs {}",
                                    graph::nameOf(reader), graph::nameOf(reader)),
              .remedy = "read a value that does not depend on the view"});
  }

  std::string sourceText(const Source& source) const {
    if (source.kind == Source::Kind::Resource) return fmt::format("the resource '{}'", source.port);
    return fmt::format("'{}.{}'{}", pipeline_.passes[source.row].name, source.port,
                       source.kind == Source::Kind::Fill ? " (its stand-in)" : "");
  }

  // Explicit wiring may name any row; what it reads must be made before.
  void checkOrder() {
    for (const ResolvedRow& row : plan_.rows)
      for (const ResolvedInput& input : row.inputs) {
        if (!isReadNow(row, input) || input.source.row < row.row) continue;
        const std::string reader = row.name;
        const std::string maker = pipeline_.passes[input.source.row].name;
        std::vector<std::string> path;
        std::set<std::size_t> seen;
        if (leadsTo(input.source.row, row.row, seen, path))
          report(row.row, inputPlace(row.row, input.port),
                 {.kind = FaultKind::Cycle,
                  .found = fmt::format("wiring that leads back: {} reads {}", reader,
                                       join(shortened(path), ", which reads ")),
                  .wanted = "passes that read only what earlier ones made",
                  .remedy = fmt::format("change one of these `reads`; only a history input may "
                                        "name its own or a later row")});
        else
          report(row.row, inputPlace(row.row, input.port),
                 {.kind = FaultKind::ReadBeforeWrite,
                  .found = fmt::format("'{}.{}', which stands later in the list", maker,
                                       input.source.port),
                  .wanted = "a pass that runs before this one",
                  .remedy = fmt::format("move '{}' before '{}'", maker, reader)});
      }
  }

  void checkSizes() {
    SizeRelations sizes(plan_);
    for (const ResolvedRow& row : plan_.rows)
      for (const ResolvedInput& input : row.inputs) {
        const std::string& other = row.description.input(input.port)->sameSizeAs;
        if (other.empty()) continue;
        const ResolvedInput* like = row.input(other);
        CHECK(like, "{}: '{}' must be as large as an input '{}' that the pass does not have",
              row.description.type, input.port, other);
        if (!isMade(input.source) || !isMade(like->source)) continue;
        const SizeRelation found = sizes.of(input.source), wanted = sizes.of(like->source);
        if (found == wanted) continue;
        report(row.row, inputPlace(row.row, input.port),
               {.kind = FaultKind::SizeMismatch,
                .found = fmt::format("{}, of {}", sourceText(input.source), found.text()),
                .wanted = fmt::format("the size of '{}', {}: {}", other, sourceText(like->source),
                                      wanted.text()),
                .remedy = "bind one of them to another value by \"reads\", or put a pass that "
                          "scales it between"});
      }
  }

  // The ends of a long way are enough.
  static std::vector<std::string> shortened(std::vector<std::string> path) {
    constexpr std::ptrdiff_t kStart = 4, kEnd = 2;
    const auto size = static_cast<std::ptrdiff_t>(path.size());
    if (size <= kStart + kEnd + 1) return path;
    path[kStart] = fmt::format("... ({} more)", size - kStart - kEnd);
    path.erase(path.begin() + kStart + 1, path.end() - kEnd);
    return path;
  }

  // An input that needs its source earlier in the same frame.
  static bool isReadNow(const ResolvedRow& row, const ResolvedInput& input) {
    return input.source.kind == Source::Kind::Output && !row.description.input(input.port)->history;
  }

  const ResolvedRow* resolvedRow(std::size_t index) const {
    const auto found = std::find_if(plan_.rows.begin(), plan_.rows.end(),
                                    [&](const ResolvedRow& r) { return r.row == index; });
    return found == plan_.rows.end() ? nullptr : &*found;
  }

  // Is there a way from `from` to `to` along reads? path gets the names on it.
  bool leadsTo(std::size_t from, std::size_t to, std::set<std::size_t>& seen,
               std::vector<std::string>& path) const {
    path.push_back(pipeline_.passes[from].name);
    if (from == to) return true;
    const ResolvedRow* row = resolvedRow(from);
    if (row && seen.insert(from).second)
      for (const ResolvedInput& input : row->inputs)
        if (isReadNow(*row, input) && leadsTo(input.source.row, to, seen, path)) return true;
    path.pop_back();
    return false;
  }

  // Typed data is updated in place and cannot be copied: nobody may want the older version.
  void checkUpdates() {
    for (const ResolvedRow& updater : plan_.rows)
      for (const PortDescription& port : updater.description.ports) {
        if (updater.culled || port.direction != Direction::InOut || port.type.texture) continue;
        const Source& old = updater.input(port.name)->source;
        if (old.kind != Source::Kind::Output || old.row >= updater.row) continue;
        if (updater.description.frequency > descriptions_[old.row]->frequency)
          report(updater.row, inputPlace(updater.row, port.name),
                 {.kind = FaultKind::WrongFrequency,
                  .found = fmt::format("{}, which is made {} only", sourceText(old),
                                       graph::nameOf(descriptions_[old.row]->frequency)),
                  .wanted = fmt::format("data made {}, as this pass updates it",
                                        graph::nameOf(updater.description.frequency)),
                  .remedy = "update data that is made as often as it is updated"});
        for (const ResolvedRow& reader : plan_.rows)
          for (const ResolvedInput& input : reader.inputs)
            if (!reader.culled && input.source.sameAs(old) &&
                wantsOld(updater, port, reader, input))
              report(reader.row, inputPlace(reader.row, input.port),
                     {.kind = FaultKind::ReadAfterUpdate,
                      .found = fmt::format("{}, which '{}' updates before this pass runs",
                                           sourceText(old), updater.name),
                      .wanted = "the newest version; data is updated in place, never copied",
                      .remedy = fmt::format("read '{}.{}', or move this pass before '{}'",
                                            updater.name, port.name, updater.name)});
      }
  }

  static bool wantsOld(const ResolvedRow& updater, const PortDescription& updated,
                       const ResolvedRow& reader, const ResolvedInput& input) {
    const bool history = reader.description.input(input.port)->history;
    if (&reader == &updater) return input.port != updated.name;
    return history || runOrder(reader) > runOrder(updater);
  }

  void resolveOutputs(const std::vector<std::string>& kept) {
    const bool given = !pipeline_.output.empty();
    Binding output = given ? wiring_.named(pipeline_.output, "color") : wiring_.last("color");
    // Without any sound row the missing output is a consequence, not a fault of its own.
    if (given || !plan_.rows.empty())
      plan_.output =
          checkedOutput(fmt::format("{}, output", place(kPipeline)), std::move(output), true);
    for (const std::string& name : kept) {
      plan_.keptNames.push_back(name);
      plan_.kept.push_back(
          checkedOutput(fmt::format("kept value '{}'", name), wiring_.named(name, name), false));
    }
  }

  Source checkedOutput(const std::string& where, Binding binding, bool mustBeImage) {
    if (binding.problem) {
      if (binding.problem->kind == FaultKind::UnknownPort)
        binding.problem->kind = FaultKind::BadOutput;
      report(kPipeline, where, *binding.problem);
      return {};
    }
    const Source& source = binding.source;
    const bool isImage =
        source.type.texture && source.type.texture->kind == gpu::TextureKind::Plain2D;
    const bool isMade = source.kind != Source::Kind::Resource;
    if (source.kind != Source::Kind::Unbound && (!isMade || (mustBeImage && !isImage)))
      report(
          kPipeline, where,
          {.kind = FaultKind::BadOutput,
           .found = fmt::format("{}, {}", sourceText(source), source.type.text()),
           .wanted = mustBeImage ? "a 2D texture that a pass makes" : "a value that a pass makes",
           .remedy = "name another \"Pass.port\""});
    return source;
  }

  // Keeps what the output, kept values and passes without outputs (which write files, say) need.
  void cull() {
    std::set<std::size_t> needed;
    std::vector<std::size_t> open;
    const auto need = [&](const Source& source) {
      if (source.kind == Source::Kind::Output && needed.insert(source.row).second)
        open.push_back(source.row);
    };
    need(plan_.output);
    for (const Source& source : plan_.kept) need(source);
    for (const ResolvedRow& row : plan_.rows) {
      const auto& ports = row.description.ports;
      if (std::none_of(ports.begin(), ports.end(), isOutput) && needed.insert(row.row).second)
        open.push_back(row.row);
    }
    while (!open.empty()) {
      const ResolvedRow* row = resolvedRow(open.back());
      open.pop_back();
      if (!row) continue;
      for (const ResolvedInput& input : row->inputs) need(input.source);
    }
    // With an unknown reader somewhere it would be hasty to say that nobody reads.
    const bool sure = wiringKnown_ && plan_.output.kind != Source::Kind::Unbound;
    for (ResolvedRow& row : plan_.rows) {
      row.culled = !needed.contains(row.row);
      if (row.culled && sure) report(row.row, place(row.row), neverRead(row), Severity::Warning);
    }
  }

  static Problem neverRead(const ResolvedRow& row) {
    std::vector<std::string> outputs;
    for (const PortDescription& port : row.description.ports)
      if (isOutput(port)) outputs.push_back(port.name);
    return {.kind = FaultKind::OutputNeverRead,
            .found = fmt::format("outputs that nothing shown depends on: {}", join(outputs)),
            .wanted = "a reader among the passes that make the picture",
            .remedy = fmt::format("'{}' is left out; read one of its outputs, or disable or remove "
                                  "the row",
                                  row.name)};
  }

  const Pipeline& pipeline_;
  const Registry& registry_;
  const gpu::Capabilities& capabilities_;
  std::vector<std::optional<PassDescription>> descriptions_;
  Wiring wiring_;
  Plan plan_;
  bool wiringKnown_ = true;                            // every pass type and every input was found
  std::vector<std::pair<std::size_t, Fault>> faults_;  // with the row that they are sorted by
};

}  // namespace

const ResolvedInput* ResolvedRow::input(std::string_view port) const {
  for (const ResolvedInput& input : inputs)
    if (input.port == port) return &input;
  return nullptr;
}

bool ResolvedRow::updates(const PortDescription& port) const {
  return port.direction == Direction::InOut &&
         input(port.name)->source.kind != Source::Kind::Unbound;
}

Validation validate(const Pipeline& pipeline, const Registry& registry,
                    const gpu::Capabilities& capabilities, const std::vector<std::string>& kept) {
  return Validator(pipeline, registry, capabilities).run(kept);
}

}  // namespace lucerna::graph
