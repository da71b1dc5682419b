// The JSON form of a pipeline.
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/json_value.hpp"
#include "core/text.hpp"
#include "graph/pipeline.hpp"

namespace lucerna::graph {
namespace {

constexpr const char* kForm = "pipeline/1";

std::optional<double> numberOf(const JsonNode& node) {
  if (const auto* integer = node.as<std::int64_t>()) return static_cast<double>(*integer);
  if (const auto* real = node.as<double>()) return *real;
  return std::nullopt;
}

std::optional<Value> valueOf(const JsonNode& node) {
  if (const auto* truth = node.as<bool>()) return Value(*truth);
  if (const auto* integer = node.as<std::int64_t>()) return Value(*integer);
  if (const auto* real = node.as<double>()) return Value(*real);
  if (const auto* text = node.as<std::string>()) return Value(*text);
  const auto* list = node.as<JsonNode::List>();
  if (!list) return std::nullopt;
  std::vector<double> numbers;
  for (const JsonNode& entry : *list) {
    const auto number = numberOf(entry);
    if (!number) return std::nullopt;
    numbers.push_back(*number);
  }
  return Value(std::move(numbers));
}

void readReads(const JsonValue& reads, PassRow& row) {
  for (const auto& [port, from] : reads.members())
    if (const auto* text = from.node().as<std::string>())
      row.reads[port] = *text;
    else
      from.wrong("\"Row.port\"");
}

void readParams(const JsonValue& params, PassRow& row) {
  for (const auto& [name, given] : params.members())
    if (auto value = valueOf(given.node()))
      row.params[name] = std::move(*value);
    else
      given.wrong(fmt::format(
          "true, false, a number, a text or a list of numbers{}",
          given.node().as<std::nullptr_t>() ? " (NaN and infinity become null in JSON)" : ""));
}

// A slip in the word "type" is one fault: the row is what it was meant to be.
void readType(const JsonValue& from, PassRow& row) {
  static const std::vector<std::string> kType{"type"};
  if (from.has("type")) {
    from.read("type", row.type);
    return;
  }
  for (const auto& [key, value] : from.members())
    if (const auto* text = value.node().as<std::string>(); text && closest(key, kType) == "type") {
      row.type = *text;
      return;
    }
  from.wrong("no \"type\"", "the name of a pass type");
}

PassRow readRow(const JsonValue& from) {
  PassRow row;
  row.place = from.place();
  if (!from.object({"name", "type", "enabled", "reads", "params", "place"})) return row;
  readType(from, row);
  row.name = row.type;
  from.read("name", row.name);
  if (row.name.find_first_of(".=") != std::string::npos)
    from.fault(fmt::format(
        "the name '{}' has a '.' or '='; wanted a name without, for \"Row.port\"", row.name));
  from.read("enabled", row.enabled);
  if (from.has("reads")) readReads(from.at("reads"), row);
  if (from.has("params")) readParams(from.at("params"), row);
  return row;
}

// Scripts say of each row which of their lines made it.
JsonValue placed(const JsonValue& row) {
  const JsonNode* place = row.node().find("place");
  const auto* text = place ? place->as<std::string>() : nullptr;
  return text ? row.placedAt(*text) : row;
}

void readPipeline(const JsonValue& root, Pipeline& pipeline) {
  root.object({"$schema", "lucerna", "name", "output", "passes"});
  root.format(kForm);
  root.read("name", pipeline.name);
  root.read("output", pipeline.output);
  if (!root.has("passes")) return;  // an empty pipeline, which is a fault that validate() knows
  std::vector<JsonValue> rows = root.at("passes").elements();
  if (rows.size() > kMaxPipelineRows) {
    root.at("passes").wrong(fmt::format("{} rows", rows.size()),
                            fmt::format("at most {}", kMaxPipelineRows));
    rows.erase(rows.begin() + kMaxPipelineRows, rows.end());
  }
  for (const JsonValue& row : rows) {
    pipeline.passes.push_back(readRow(placed(row)));
    if (std::string& name = pipeline.passes.back().name; name.empty())
      name = fmt::format("row {}", pipeline.passes.size());
  }
}

}  // namespace

Result<Pipeline> pipelineFromJson(const std::string& text, const std::string& source) {
  LUCERNA_TRY(document, JsonDocument::parse(text, source, ErrorKind::Pipeline));
  const JsonValue root = document.root();
  if (!root.node().as<JsonNode::Members>())
    return error(ErrorKind::Pipeline,
                 "{}: found {}, wanted an object {{\"lucerna\": \"{}\", \"passes\": [...]}}",
                 root.place(), root.found(), kForm);
  Pipeline pipeline;
  pipeline.source = source;
  readPipeline(root, pipeline);
  for (JsonFault& fault : document.faults())
    pipeline.formFaults.push_back({.kind = FaultKind::BadForm,
                                   .place = std::move(fault.place),
                                   .found = std::move(fault.found),
                                   .wanted = std::move(fault.wanted)});
  return pipeline;
}

std::string toJson(const Pipeline& pipeline) {
  using ordered = nlohmann::ordered_json;
  ordered root{{"lucerna", kForm}};
  if (!pipeline.name.empty()) root["name"] = pipeline.name;
  if (!pipeline.output.empty()) root["output"] = pipeline.output;
  root["passes"] = ordered::array();
  for (const PassRow& row : pipeline.passes) {
    ordered object{{"name", row.name}, {"type", row.type}};
    if (!row.enabled) object["enabled"] = false;
    if (!row.reads.empty()) object["reads"] = row.reads;
    for (const auto& [name, value] : row.params)
      std::visit([&, &key = name](const auto& v) { object["params"][key] = v; }, value);
    root["passes"].push_back(std::move(object));
  }
  return root.dump(2, ' ', false, ordered::error_handler_t::replace);
}

}  // namespace lucerna::graph
