#include "core/json_value.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/text.hpp"

namespace lucerna {
namespace {

constexpr std::size_t kShownCharacters = 60;
constexpr std::size_t kShownPointer = 200;

std::string shortened(std::string text, std::size_t length = kShownCharacters) {
  if (text.size() <= length) return text;
  while (length > 0 && (text[length] & 0xC0) == 0x80) --length;  // not inside a character of UTF-8
  return text.substr(0, length) + "...";
}

// ~ and / of a key as a JSON pointer writes them (RFC 6901).
std::string escaped(std::string_view key) {
  std::string result;
  for (const char c : key) {
    if (c == '~')
      result += "~0";
    else if (c == '/')
      result += "~1";
    else
      result += c;
  }
  return result;
}

// Appends the value as JSON, as far as anybody reads on.
struct Print {
  std::string text;

  bool enough() const { return text.size() > kShownCharacters; }
  template <typename T>
  void scalar(const T& value) {
    text += nlohmann::json(value).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  }
  void operator()(std::nullptr_t) { text += "null"; }
  void operator()(bool value) { text += value ? "true" : "false"; }
  void operator()(std::int64_t value) { scalar(value); }
  void operator()(double value) { scalar(value); }
  void operator()(const std::string& value) { scalar(value.substr(0, 2 * kShownCharacters)); }
  void operator()(const JsonNode::List& list) {
    text += '[';
    for (std::size_t i = 0; i < list.size() && !enough(); ++i) {
      if (i > 0) text += ',';
      std::visit(*this, list[i].value);
    }
    text += ']';
  }
  void operator()(const JsonNode::Members& members) {
    text += '{';
    for (std::size_t i = 0; i < members.size() && !enough(); ++i) {
      if (i > 0) text += ',';
      (*this)(members[i].key);
      text += ':';
      std::visit(*this, members[i].value.value);
    }
    text += '}';
  }
};

std::string rangeText(const NumberRange& range) {
  const std::string unit = *range.unit ? fmt::format(" {}", range.unit) : "";
  if (range.max < 1e30f) return fmt::format("a number from {} to {}{}", range.min, range.max, unit);
  if (range.min > -1e30f) return fmt::format("a number of at least {}{}", range.min, unit);
  return "a number" + unit;
}

}  // namespace

std::string JsonFault::text() const {
  if (wanted.empty()) return fmt::format("{}: {}", place, found);
  return fmt::format("{}: found {}, wanted {}", place, found, wanted);
}

void JsonFaults::add(JsonFault fault) {
  if (full())
    ++uncounted_;
  else if (std::ranges::find(list_, fault) == list_.end())  // a value may be read more than once
    list_.push_back(std::move(fault));
}

std::vector<JsonFault> JsonFaults::list() const {
  std::vector<JsonFault> faults = list_;
  if (uncounted_ > 0) faults.push_back({file_, fmt::format("{} more faults", uncounted_), ""});
  return faults;
}

std::string JsonValue::place() const {
  return place_ ? *place_ : fmt::format("{}:{}", faults_->file(), node_->line);
}

JsonValue JsonValue::placedAt(std::string place) const {
  JsonValue value = *this;
  value.place_ = std::make_shared<const std::string>(std::move(place));
  return value;
}

void JsonValue::fault(std::string complaint) const {
  wrong(std::move(complaint), "");
}

void JsonValue::wrong(const std::string& wanted) const {
  wrong(faults_->full() ? "" : found(), wanted);
}

void JsonValue::wrong(std::string found, std::string wanted) const {
  if (faults_->full()) return faults_->add({});
  faults_->add(
      {fmt::format("{}: {}", place(), pointer_.empty() ? "/" : shortened(pointer_, kShownPointer)),
       std::move(found), std::move(wanted)});
}

std::string JsonValue::found() const {
  Print print;
  std::visit(print, node_->value);
  return shortened(std::move(print.text));
}

bool JsonValue::object(std::initializer_list<const char*> known) const {
  const auto* list = node_->as<JsonNode::Members>();
  if (!list) {
    wrong("an object");
    return false;
  }
  const std::vector<std::string> names(known.begin(), known.end());
  for (const auto& [key, node] : *list) {
    if (std::find(names.begin(), names.end(), key) != names.end()) continue;
    if (faults_->full())
      faults_->add({});
    else
      child(node, key).wrong(
          fmt::format("the unknown key '{}'{}", shortened(key), didYouMean(key, names)),
          "one of " + join(names));
  }
  return true;
}

void JsonValue::require(std::initializer_list<const char*> keys) const {
  for (const char* key : keys)
    if (!has(key)) fault(fmt::format("'{}' is missing", key));
}

void JsonValue::format(const std::string& format) const {
  if (!has("lucerna")) return wrong("no \"lucerna\"", fmt::format("\"lucerna\": \"{}\"", format));
  std::string found;
  if (read("lucerna", found) && found != format) at("lucerna").wrong(fmt::format("\"{}\"", format));
}

bool JsonValue::isNumber() const {
  return node_->as<std::int64_t>() || node_->as<double>();
}

bool JsonValue::isList() const {
  return node_->as<JsonNode::List>() != nullptr;
}

JsonValue JsonValue::child(const JsonNode& node, std::string_view step) const {
  JsonValue value = *this;
  value.node_ = &node;
  value.pointer_ += '/';
  value.pointer_ += escaped(step);
  return value;
}

JsonValue JsonValue::at(std::string_view key) const {
  const JsonNode* node = node_->find(key);
  CHECK(node, "{} has no '{}'", pointer_, key);
  return child(*node, key);
}

std::vector<std::pair<std::string, JsonValue>> JsonValue::members() const {
  std::vector<std::pair<std::string, JsonValue>> result;
  const auto* list = node_->as<JsonNode::Members>();
  if (!list) wrong("an object");
  if (list)
    for (const auto& [key, node] : *list) result.emplace_back(key, child(node, key));
  return result;
}

std::vector<JsonValue> JsonValue::elements() const {
  std::vector<JsonValue> result;
  const auto* list = node_->as<JsonNode::List>();
  if (!list) {
    wrong("a list");
    return result;
  }
  for (std::size_t i = 0; i < list->size(); ++i)
    result.push_back(child((*list)[i], std::to_string(i)));
  return result;
}

bool JsonValue::number(float& out, NumberRange range) const {
  double value = std::nan("");
  if (const auto* integer = node_->as<std::int64_t>()) value = static_cast<double>(*integer);
  if (const auto* real = node_->as<double>()) value = *real;
  if (value >= range.min && value <= range.max) {
    out = static_cast<float>(value);
    return true;
  }
  // Beyond what the others leave open.
  const bool huge = std::abs(value) > 1e30;
  wrong(huge ? fmt::format("a number from {} to {}", range.min, range.max) : rangeText(range));
  return false;
}

bool JsonValue::numbers(std::span<float> out, NumberRange range) const {
  const auto* list = node_->as<JsonNode::List>();
  if (!list || list->size() != out.size()) {
    wrong(fmt::format("a list of {} numbers", out.size()));
    return false;
  }
  std::vector<float> values(out.size());
  bool good = true;
  const std::vector<JsonValue> entries = elements();
  for (std::size_t i = 0; i < entries.size(); ++i)
    good = entries[i].number(values[i], range) && good;
  if (good) std::copy(values.begin(), values.end(), out.begin());
  return good;
}

bool JsonValue::text(std::string& out) const {
  const auto* value = node_->as<std::string>();
  if (!value || value->empty()) {
    wrong("a text");
    return false;
  }
  out = *value;
  return true;
}

bool JsonValue::choice(std::span<const std::string> choices, std::size_t& out) const {
  const auto* value = node_->as<std::string>();
  const auto found = value ? std::find(choices.begin(), choices.end(), *value) : choices.end();
  if (found == choices.end()) {
    wrong(fmt::format("one of {}{}", join(choices), value ? didYouMean(*value, choices) : ""));
    return false;
  }
  out = static_cast<std::size_t>(found - choices.begin());
  return true;
}

bool JsonValue::read(const char* key, float& out, NumberRange range) const {
  return has(key) && at(key).number(out, range);
}

bool JsonValue::read(const char* key, bool& out) const {
  if (!has(key)) return false;
  const JsonValue value = at(key);
  const auto* truth = value.node_->as<bool>();
  if (!truth) {
    value.wrong("true or false");
    return false;
  }
  out = *truth;
  return true;
}

bool JsonValue::read(const char* key, std::string& out) const {
  return has(key) && at(key).text(out);
}

bool JsonValue::readInteger(const char* key, int& out, int min, int max) const {
  if (!has(key)) return false;
  const JsonValue value = at(key);
  const auto* integer = value.node_->as<std::int64_t>();
  if (!integer || *integer < min || *integer > max) {
    value.wrong(fmt::format("a whole number from {} to {}", min, max));
    return false;
  }
  out = static_cast<int>(*integer);
  return true;
}

bool JsonValue::readDegrees(const char* key, float& out, NumberRange degrees) const {
  degrees.unit = "degrees";
  float value = 0.f;
  if (!read(key, value, degrees)) return false;
  out = glm::radians(value);
  return true;
}

bool JsonValue::readChoice(const char* key, std::initializer_list<const char*> names,
                           int& out) const {
  std::size_t index = 0;
  if (!has(key) || !at(key).choice(std::vector<std::string>(names.begin(), names.end()), index))
    return false;
  out = static_cast<int>(index);
  return true;
}

Result<JsonDocument> JsonDocument::parse(std::string_view text, const std::string& file,
                                         ErrorKind kind) {
  LUCERNA_TRY(parsed, parseJson(text, file, kind));
  JsonFaults faults(file);
  for (const auto& [key, line] : parsed.duplicates)
    faults.add(
        {fmt::format("{}:{}", file, line),
         fmt::format("the key \"{}\" stands twice in its object; remove one", shortened(key)), ""});
  return JsonDocument(std::move(parsed.root), std::move(faults), kind);
}

Status JsonDocument::status() const {
  const std::vector<JsonFault> all = faults();
  if (all.empty()) return {};
  std::vector<std::string> lines;
  for (const JsonFault& fault : all) lines.push_back(fault.text());
  return Error{kind_, join(lines, "\n")};
}

}  // namespace lucerna
