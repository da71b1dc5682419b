// The JSON form of a pipeline.
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "core/text.hpp"
#include "graph/pipeline.hpp"

namespace lucerna::graph {
namespace {

using nlohmann::json;

constexpr std::string_view kForm = "pipeline/1";

std::size_t lineAt(const std::string& text, std::size_t offset) {
  const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(offset, text.size()));
  return 1 + static_cast<std::size_t>(std::count(text.begin(), end, '\n'));
}

// What nlohmann's parser does not tell: how deep the text nests, where the rows begin.
struct Outline {
  int depth = 0;
  std::size_t deepest = 0;            // offset of the first bracket beyond the limit
  std::vector<std::size_t> rowLines;  // of the objects in the array "passes"
};

Outline outlineOf(const std::string& text) {
  Outline outline;
  int depth = 0;
  std::string rootKey;
  std::size_t line = 1;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '\n') ++line;
    if (c == '"') {
      const std::size_t begin = ++i;
      while (i < text.size() && text[i] != '"') i += text[i] == '\\' ? 2 : 1;
      if (depth == 1) rootKey = text.substr(begin, std::min(i, text.size()) - begin);
    } else if (c == '[' || c == '{') {
      if (++depth > kMaxPipelineDepth && outline.deepest == 0) outline.deepest = i;
      outline.depth = std::max(outline.depth, depth);
      if (depth == 3 && c == '{' && rootKey == "passes") outline.rowLines.push_back(line);
    } else if (c == ']' || c == '}') {
      --depth;
    }
  }
  return outline;
}

class Reader {
 public:
  Reader(const std::string& text, const std::string& source) : text_(text), source_(source) {}

  Result<Pipeline> read() {
    json root;
    if (!parse(root)) return failure();
    if (!root.is_object()) {
      fault(source_, "found {}, wanted an object {{\"lucerna\": \"{}\", \"passes\": [...]}}",
            root.type_name(), kForm);
      return failure();
    }
    Pipeline pipeline;
    pipeline.source = source_;
    checkKeys(root, source_, {"$schema", "lucerna", "name", "output", "passes"});
    if (const auto form = root.find("lucerna"); form == root.end())
      fault(source_, "the key \"lucerna\" is missing; wanted \"lucerna\": \"{}\"", kForm);
    else if (*form != kForm)
      fault(source_, "\"lucerna\" is {}; wanted \"{}\", the only form this version reads",
            shown(*form), kForm);
    readText(root, "name", source_, pipeline.name);
    readText(root, "output", source_, pipeline.output);
    readPasses(root, pipeline);
    if (!faults_.empty()) return failure();
    return pipeline;
  }

 private:
  template <typename... Args>
  void fault(const std::string& place, fmt::format_string<Args...> format, Args&&... args) {
    faults_.push_back(place + ": " + fmt::format(format, std::forward<Args>(args)...));
  }
  Error failure() const { return {ErrorKind::Pipeline, join(faults_, "\n")}; }

  static std::string shown(const json& value) {
    std::string text = value.dump(-1, ' ', false, json::error_handler_t::replace);
    if (text.size() > 60) text = text.substr(0, 57) + "...";
    return text;
  }

  bool parse(json& root) {
    if (text_.size() > kMaxPipelineBytes) {
      fault(source_, "found {} bytes, wanted at most {}; a pipeline is a short list of passes",
            text_.size(), kMaxPipelineBytes);
      return false;
    }
    const Outline outline = outlineOf(text_);
    rowLines_ = outline.rowLines;
    if (outline.depth > kMaxPipelineDepth) {
      fault(fmt::format("{}:{}", source_, lineAt(text_, outline.deepest)),
            "brackets nest {} deep, wanted at most {}", outline.depth, kMaxPipelineDepth);
      return false;
    }
    std::vector<std::set<std::string>> keys;
    std::vector<std::string> doubled;
    const auto watch = [&](int, json::parse_event_t event, json& value) {
      if (event == json::parse_event_t::object_start) keys.emplace_back();
      if (event == json::parse_event_t::object_end) keys.pop_back();
      if (event == json::parse_event_t::key && !keys.back().insert(value.get<std::string>()).second)
        doubled.push_back(value.get<std::string>());
      return true;
    };
    try {
      root = json::parse(text_, watch);
    } catch (const json::parse_error& e) {
      const std::string what = e.what();
      const std::size_t colon = what.find(": ");
      fault(fmt::format("{}:{}", source_, lineAt(text_, e.byte > 0 ? e.byte - 1 : 0)),
            "no JSON: {}; correct the text there",
            colon == std::string::npos ? what : what.substr(colon + 2));
      return false;
    } catch (const json::exception& e) {
      fault(source_, "no JSON: {}; correct the text", e.what());
      return false;
    }
    for (const std::string& key : doubled)
      fault(source_, "the key \"{}\" stands twice in one object; remove one", key);
    return true;
  }

  void checkKeys(const json& object, const std::string& place,
                 const std::vector<std::string>& known) {
    for (const auto& [key, value] : object.items())
      if (std::find(known.begin(), known.end(), key) == known.end())
        fault(place, "unknown key \"{}\"{}; wanted {}", key, didYouMean(key, known), join(known));
  }

  void readText(const json& object, const char* key, const std::string& place,
                std::string& result) {
    const auto found = object.find(key);
    if (found == object.end()) return;
    if (found->is_string())
      result = found->get<std::string>();
    else
      fault(place, "\"{}\" is {}, wanted a text", key, shown(*found));
  }

  void readPasses(const json& root, Pipeline& pipeline) {
    const auto passes = root.find("passes");
    if (passes == root.end() || !passes->is_array()) {
      fault(source_, "\"passes\" is {}, wanted a list of rows {{\"type\": \"...\"}}",
            passes == root.end() ? "missing" : shown(*passes));
      return;
    }
    if (passes->size() > kMaxPipelineRows) {
      fault(source_, "\"passes\" has {} rows, wanted at most {}", passes->size(), kMaxPipelineRows);
      return;
    }
    for (std::size_t i = 0; i < passes->size(); ++i)
      pipeline.passes.push_back(readRow((*passes)[i], i));
  }

  std::string placeOf(const json& row, std::size_t index) const {
    if (row.is_object())
      if (const auto place = row.find("place"); place != row.end() && place->is_string())
        return place->get<std::string>();
    if (index < rowLines_.size()) return fmt::format("{}:{}", source_, rowLines_[index]);
    return fmt::format("{}, row {}", source_, index + 1);
  }

  PassRow readRow(const json& object, std::size_t index) {
    PassRow row;
    row.place = placeOf(object, index);
    const std::string place = fmt::format("{}, passes[{}]", row.place, index);
    if (!object.is_object()) {
      fault(place, "found {}, wanted an object {{\"type\": \"...\"}}", shown(object));
      return row;
    }
    checkKeys(object, place, {"name", "type", "enabled", "reads", "params", "place"});
    readText(object, "type", place, row.type);
    row.name = row.type;
    readText(object, "name", place, row.name);
    if (row.name.empty() && !row.type.empty())
      fault(place, "the name is empty; leave \"name\" out or give one");
    if (!object.contains("type")) fault(place, "the key \"type\" is missing; name a pass type");
    if (row.name.find_first_of(".=") != std::string::npos)
      fault(place, "the name '{}' has a '.' or '='; wanted a name without, for \"Row.port\"",
            row.name);
    if (const auto enabled = object.find("enabled"); enabled != object.end()) {
      if (enabled->is_boolean())
        row.enabled = enabled->get<bool>();
      else
        fault(place, "\"enabled\" is {}, wanted true or false", shown(*enabled));
    }
    readReads(object, place, row);
    readParams(object, place, row);
    return row;
  }

  void readReads(const json& object, const std::string& place, PassRow& row) {
    const auto reads = object.find("reads");
    if (reads == object.end()) return;
    if (!reads->is_object())
      return fault(place, "\"reads\" is {}, wanted an object {{\"input\": \"Row.port\"}}",
                   shown(*reads));
    for (const auto& [port, from] : reads->items())
      if (from.is_string())
        row.reads[port] = from.get<std::string>();
      else
        fault(place, "\"reads\".\"{}\" is {}, wanted \"Row.port\"", port, shown(from));
  }

  void readParams(const json& object, const std::string& place, PassRow& row) {
    const auto params = object.find("params");
    if (params == object.end()) return;
    if (!params->is_object())
      return fault(place, "\"params\" is {}, wanted an object {{\"name\": value}}", shown(*params));
    for (const auto& [name, value] : params->items())
      if (auto read = readValue(value))
        row.params[name] = std::move(*read);
      else
        fault(place,
              "\"params\".\"{}\" is {}, wanted true, false, a number, a text or a list of numbers"
              "{}",
              name, shown(value), value.is_null() ? " (NaN and infinity become null in JSON)" : "");
  }

  static std::optional<Value> readValue(const json& value) {
    if (value.is_boolean()) return Value(value.get<bool>());
    if (value.is_number_unsigned() && value.get<std::uint64_t>() > INT64_MAX)
      return Value(value.get<double>());
    if (value.is_number_integer()) return Value(value.get<std::int64_t>());
    if (value.is_number()) return Value(value.get<double>());
    if (value.is_string()) return Value(value.get<std::string>());
    if (!value.is_array()) return std::nullopt;
    std::vector<double> numbers;
    for (const json& number : value) {
      if (!number.is_number()) return std::nullopt;
      numbers.push_back(number.get<double>());
    }
    return Value(std::move(numbers));
  }

  const std::string& text_;
  const std::string& source_;
  std::vector<std::size_t> rowLines_;
  std::vector<std::string> faults_;
};

}  // namespace

Result<Pipeline> pipelineFromJson(const std::string& text, const std::string& source) {
  return Reader(text, source).read();
}

std::string toJson(const Pipeline& pipeline) {
  using ordered = nlohmann::ordered_json;
  ordered root{{"lucerna", kForm}, {"name", pipeline.name}};
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
