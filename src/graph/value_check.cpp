#include "graph/value_check.hpp"

#include <charconv>
#include <cmath>

#include "core/text.hpp"
#include "graph/pass.hpp"

namespace lucerna::graph {
namespace {

std::string foundText(const Value& value) {
  struct Visitor {
    const char* operator()(bool) const { return "a bool"; }
    const char* operator()(std::int64_t) const { return "an integer"; }
    const char* operator()(double) const { return "a number"; }
    const char* operator()(const std::string&) const { return "a text"; }
    const char* operator()(const std::vector<double>&) const { return "a list"; }
  };
  const bool isText = std::holds_alternative<std::string>(value);
  return fmt::format("{}{}{} ({})", isText ? "'" : "", toText(value), isText ? "'" : "",
                     std::visit(Visitor{}, value));
}

bool hasType(const ParamDescription& param, const Value& value) {
  switch (param.type) {
    case ParamType::Bool:
      return std::holds_alternative<bool>(value);
    case ParamType::Int:
      return std::holds_alternative<std::int64_t>(value);
    case ParamType::Float:
      return asNumber(value).has_value();
    case ParamType::Choice:
    case ParamType::Text:
    case ParamType::File:
      return std::holds_alternative<std::string>(value);
    case ParamType::Color:
    case ParamType::Vector: {
      const auto* list = std::get_if<std::vector<double>>(&value);
      return list && list->size() == param.size;
    }
  }
  return false;
}

// Finite as the 32-bit float that passes hold.
bool inRange(const ParamDescription& param, double number) {
  return std::isfinite(static_cast<float>(number)) && number >= param.min.value_or(number) &&
         number <= param.max.value_or(number);
}

bool fitsInt(std::int64_t number) {
  return number >= INT32_MIN && number <= INT32_MAX;
}

bool inRange(const ParamDescription& param, const Value& value) {
  if (const auto* integer = std::get_if<std::int64_t>(&value); integer && !fitsInt(*integer))
    return param.type == ParamType::Float && inRange(param, static_cast<double>(*integer));
  if (const auto number = asNumber(value)) return inRange(param, *number);
  if (const auto* list = std::get_if<std::vector<double>>(&value))
    for (const double number : *list)
      if (!inRange(param, number)) return false;
  return true;
}

std::optional<double> parseNumber(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  double number = 0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (fault != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return number;
}

std::optional<Value> parseList(std::string_view text) {
  if (text.size() >= 2 && text.front() == '[' && text.back() == ']')
    text = text.substr(1, text.size() - 2);
  std::vector<double> numbers;
  for (const std::string& part : split(text, ',')) {
    const auto number = parseNumber(part);
    if (!number) return std::nullopt;
    numbers.push_back(*number);
  }
  return Value(std::move(numbers));
}

// None if the text has not the form of the type.
std::optional<Value> parseForm(const ParamDescription& param, const std::string& text) {
  switch (param.type) {
    case ParamType::Bool:
      if (text == "true" || text == "on" || text == "1") return Value(true);
      if (text == "false" || text == "off" || text == "0") return Value(false);
      return std::nullopt;
    case ParamType::Int: {
      std::int64_t number = 0;
      const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), number);
      if (fault != std::errc{} || end != text.data() + text.size()) return std::nullopt;
      return Value(number);
    }
    case ParamType::Float: {
      const auto number = parseNumber(text);
      return number ? std::optional<Value>(*number) : std::nullopt;
    }
    case ParamType::Choice:
    case ParamType::Text:
    case ParamType::File:
      return Value(text);
    case ParamType::Color:
    case ParamType::Vector:
      return parseList(text);
  }
  return std::nullopt;
}

}  // namespace

std::string wantedText(const ParamDescription& param) {
  std::string text;
  switch (param.type) {
    case ParamType::Bool:
      return "true or false";
    case ParamType::Text:
      return "a text";
    case ParamType::File:
      return "the path of a file";
    case ParamType::Choice:
      return fmt::format("one of {}", join(param.choices));
    case ParamType::Int:
      text = "an integer";
      break;
    case ParamType::Float:
      text = "a number";
      break;
    case ParamType::Color:
    case ParamType::Vector:
      text = fmt::format("a list of {} numbers", param.size);
      break;
  }
  if (param.min && param.max)
    text += fmt::format(" from {} to {}", *param.min, *param.max);
  else if (param.min)
    text += fmt::format(", at least {}", *param.min);
  else if (param.max)
    text += fmt::format(", at most {}", *param.max);
  if (!param.unit.empty()) text += fmt::format(" ({})", param.unit);
  return text;
}

std::optional<ValueFault> checkValue(const ParamDescription& param, const Value& value) {
  ValueFault fault{.found = foundText(value), .wanted = wantedText(param), .remedy = {}};
  fault.remedy = fmt::format("the default is {}", toText(param.defaultValue));
  if (!hasType(param, value)) {
    fault.wrongType = true;
    return fault;
  }
  if (param.type == ParamType::Choice) {
    const auto& name = std::get<std::string>(value);
    for (const std::string& choice : param.choices)
      if (choice == name) return std::nullopt;
    if (const std::string near = closest(name, param.choices); !near.empty())
      fault.remedy = fmt::format("did you mean '{}'?", near);
    return fault;
  }
  if (inRange(param, value)) return std::nullopt;
  return fault;
}

Result<Value> parseValue(const ParamDescription& param, const std::string& text) {
  const auto value = parseForm(param, text);
  if (!value)
    return error(ErrorKind::Usage, "'{}' is no value of '{}': wanted {}; the default is {}", text,
                 param.name, wantedText(param), toText(param.defaultValue));
  if (const auto fault = checkValue(param, *value))
    return error(ErrorKind::Usage, "'{}' is no value of '{}': found {}, wanted {}; {}", text,
                 param.name, fault->found, fault->wanted, fault->remedy);
  return *value;
}

PassDescription describeChecked(const PassType& type, const ParamValues& values) {
  PassDescription description = type.describe({});
  ParamValues checked;
  // A parameter may exist only for some values of others: again, until no value is added.
  for (std::size_t count = 0;; count = checked.size()) {
    for (const auto& [name, value] : values)
      if (const ParamDescription* param = description.param(name);
          param && !checkValue(*param, value))
        checked[name] = value;
    if (checked.size() == count) return description;
    description = type.describe(checked);
  }
}

}  // namespace lucerna::graph
